#pragma once

#include <string>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/model/points.hpp"
#include "core/model/topic_study.hpp"
#include "core/pairs/orientation.hpp"

namespace mapproof {

/// Landmarks that hold together, and how firmly they hang on the others.
struct RigidPart {
  std::vector<int> landmarks;  ///< Ascending.
  int pairs = 0;               ///< Measured pairs with landmarks of other parts,
  int scans = 0;               ///< and in how many scans these were seen.
};

/// What measured pairs and the orientations of triples determine up to translation and rotation.
struct RigidParts {
  std::vector<RigidPart> parts;  ///< The largest first; each landmark in one of them.
};

inline constexpr int kFirmScans = 3;  ///< A pair of fewer may be of wrong landmark IDs.

/// The parts of a map of which each has one shape alone, generically: a part grows from a pair by
/// landmarks with three firm pairs to it, or two and a triple whose orientation was seen. Two parts
/// join if they share three landmarks, or two and a firm pair or triple, or one and two firm pairs,
/// or none and four: with fewer the one may fold over, or turn about, the other. A pair is firm
/// from kFirmScans scans on.
/// @param pairs  first < second < landmarks.
/// @param turns  May be empty.
/// @param is_mapped  Which landmarks to divide; of size `landmarks`.
/// @note O(landmarks pairs) for each part.
RigidParts rigid_parts(const std::vector<MeasuredPair>& pairs,
                       const std::vector<SeenOrientation>& turns,
                       const std::vector<bool>& is_mapped);

/// How the distances that single scans measure spread about a map.
struct ScatterFit {
  int pairs = 0;          ///< Pairs of detections in one scan.
  double median_m = 0.0;  ///< Median distance on the map.
  double sigma_m = 0.0;   ///< Robust standard deviation of the residuals at that distance.
  double relative = 0.0;  ///< sigma_m / median_m.
  double gross = 0.0;     ///< Share of the residuals beyond 6 standard deviations.
  double tail = 0.0;      ///< 90 % quantile over the median of the normalised residuals; 2.44 if
                          ///< they are normal.
  std::vector<int> worst =
      {};  ///< Landmarks with the greatest shares of gross residuals, at most 4.
};

/// One robot's scans, compared with those of the others.
struct RobotFit {
  int robot = 0;  ///< As in ScanKey.
  int pairs = 0;
  double ratio = 1.0;     ///< Median of measured over mapped distance, over that of all robots.
  int triples = 0;        ///< Of landmarks clearly not on one line,
  double mirrored = 0.0;  ///< and the share of them in the opposite orientation to the map's.
};

/// How weakly the pairs hold the landmarks together.
struct WeakMode {
  double sigma_m = 0.0;  ///< Standard deviation of the most uncertain landmark in the weakest
                         ///< mode that is neither translation nor rotation; infinite: none at all.
  std::vector<int> landmarks = {};  ///< That move most in it, at most 4.
};

/// What the scans of range and bearing say of a map made of them.
struct PairFit {
  int landmarks = 0;   ///< On the map.
  int measured = 0;    ///< Pairs of landmarks that some scan measured.
  int redundancy = 0;  ///< Measured pairs, less the unknowns of the map.
  ScatterFit scatter;
  std::vector<RobotFit> robots;
  std::vector<RigidPart> parts;
  WeakMode weakest;
};

/// Compares a map with the scans it is made of, without any other knowledge.
///
/// The residual of a pair of detections is its distance in the scan less that on the map. Its
/// standard deviation is a line in the squared distance through the robust deviations of the nearer
/// and the farther half of the residuals, so that up to half of them may be wrong.
/// @param map  M x 2, in metres, with the orientation that the scans show; NaN rows: not mapped.
/// @note Linear in the pairs of detections; O(M^3) for the weakest mode, up to 300 landmarks.
PairFit pair_fit(const DetectionLog& log, const Points& map);

/// A rigid fit of a map to known positions.
struct KnownFit {
  int positions = 0;        ///< Known positions of mapped landmarks.
  double misfit_m = 0.0;    ///< Root mean square distance after the rigid fit of least squares.
  double scale = 1.0;       ///< Of the similarity of least squares: known over mapped.
  double scaled_m = 0.0;    ///< Misfit of that similarity.
  double mirrored_m = 0.0;  ///< Misfit of the reflected map.
  int worst = -1;           ///< The landmark without which the others fit best,
  double without_worst_m = 0.0;   ///< and their misfit then.
  double worst_miss_m = 0.0;      ///< Its own distance, by the fit to the others.
  double second_without_m = 0.0;  ///< The misfit without the landmark that is the next best one.
};

/// Compares a map with known positions.
/// @param known_m  M x 2; NaN rows: unknown.
KnownFit known_fit(const Points& map, const Points& known_m);

}  // namespace mapproof
