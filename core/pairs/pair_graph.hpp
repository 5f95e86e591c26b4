#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/graph/neighbours.hpp"
#include "core/model/detection_log.hpp"
#include "core/pairs/pair_distances.hpp"

namespace mapproof {

/// Whether both range and bearing are there.
inline bool is_located(const Detection& seen) {
  return std::isfinite(seen.range_m) && std::isfinite(seen.bearing_rad);
}

/// Where the robot saw it, in its own frame.
inline Eigen::RowVector2d position_observed(const Detection& seen) {
  return seen.range_m * Eigen::RowVector2d(std::cos(seen.bearing_rad), std::sin(seen.bearing_rad));
}

inline double cross(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

inline constexpr int kPairsToPlace = 3;  ///< Two leave a landmark's reflection open.

/// For each pair: whether it was seen in so many scans, or one of its landmarks has too few pairs
/// that were.
std::vector<bool> are_trusted(const std::vector<MeasuredPair>& pairs, std::size_t landmarks,
                              int fewest_scans);

/// The pairs as edges as long as they were measured; edges ascend.
Graph graph_of(const std::vector<MeasuredPair>& pairs, std::size_t landmarks);

}  // namespace mapproof
