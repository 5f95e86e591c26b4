#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/evaluate/path_evaluation.hpp"
#include "core/model/points.hpp"

namespace mapproof {

/// Landmarks of a map or of the ground truth.
struct LandmarkPositions {
  std::vector<std::string> names;  ///< M, all different.
  Points positions_m;              ///< M x 2, finite.
};

/// How landmarks of the map are associated with those of the ground truth.
enum class LandmarkAssociation {
  kId,       ///< By their names.
  kNearest,  ///< By their positions alone, one to one.
};

struct LandmarkEvaluationOptions {
  LandmarkAssociation association = LandmarkAssociation::kId;
  FrameAlignment alignment = FrameAlignment::kRigid;
  /// An alignment that is known, of a path in the same frame; empty: fitted to the landmarks.
  std::optional<SpaceSimilarity> known = {};
  /// Of kNearest: landmarks farther apart are not associated, > 0; empty: half of the median
  /// distance between neighbours in the ground truth.
  std::optional<double> gate_m = {};
};

struct LandmarkEvaluation {
  std::vector<std::string> names;     ///< n, of the ground truth.
  Points estimate_m, ground_truth_m;  ///< n x 2; the estimate is aligned.
  Eigen::VectorXd error_m;            ///< n.
  Eigen::Index missed = 0;            ///< Of the ground truth, not in the map.
  Eigen::Index spurious = 0;          ///< Of the map, not in the ground truth.
};

/// Position errors of a map of landmarks.
///
/// With kNearest and an alignment to be fitted, the alignment is sought over pairs of landmarks:
/// two of the map against two of the ground truth, the longest first. The best has the least sum of
/// squared distances from the ground truth to the nearest landmark of the map, each at most the
/// gate [torr2000]. It is refined by least squares until the association stays.
/// @throws InvalidInput if no landmark can be associated (two, if an alignment is to be fitted;
/// three
///         with kNearest), if an option breaks its bounds, or kFirstPose without `known`.
/// @note kNearest: about 1e9 distances at most.
LandmarkEvaluation evaluate_landmarks(const LandmarkPositions& ground_truth,
                                      const LandmarkPositions& estimate,
                                      const LandmarkEvaluationOptions& options);

}  // namespace mapproof
