#pragma once

#include <vector>

#include "core/model/detection_log.hpp"
#include "core/model/topic_study.hpp"

namespace mapproof {

/// How precise a measured distance is taken to be. All are shares, so that the unit of length is
/// free.
struct PairNoise {
  /// The part that no number of scans reduces, as a share of the distance: a sensor's own errors.
  double relative = 0.03;
  /// The same, as a share of the median distance of all pairs.
  double floor = 0.01;
  /// Number of scans that the scatter common to all pairs counts for in a pair's own.
  double prior_scans = 3.0;
};

/// Distance of two landmarks seen in one scan, by the law of cosines in a form that keeps small
/// distances; NaN unless range and bearing of both were measured.
double scan_distance(const Detection& a, const Detection& b);

/// Distances of landmarks seen in one scan: by the law of cosines from both ranges and the angle
/// between both bearings, independent of the pose. Each pair gets the median over its scans, so
/// that up to half of them may be outliers.
///
/// The precision is 1 / (floor^2 + relative^2 + scatter^2 / scans): scatter from the median
/// absolute deviation, drawn towards the median scatter of all pairs as if that had been seen in
/// `prior_scans` more scans.
/// @return Every pair with a scan that measured range and bearing of both; ascending.
/// @throws InvalidInput if a detection names no landmark or a value is infinite; or an option is
///         negative or not finite.
/// @note O(sum of k^2) time over scans with k detections. At most 2000 scans of a pair are used,
///       fewer where there are more than 12,500 pairs, spread evenly over those there are: up to
///       200 MB, and 4 M^2 bytes to count.
std::vector<MeasuredPair> measured_pairs(const DetectionLog& log, const PairNoise& noise = {});

}  // namespace mapproof
