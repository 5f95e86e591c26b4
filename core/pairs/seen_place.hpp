#pragma once

#include <cmath>

#include <Eigen/Core>

#include "core/model/detection_log.hpp"

namespace mapproof {

/// Whether range and bearing are there both.
inline bool is_located(const Detection& seen) {
  return std::isfinite(seen.range_m) && std::isfinite(seen.bearing_rad);
}

/// Where the robot saw it, in its own frame.
inline Eigen::RowVector2d place_seen(const Detection& seen) {
  return seen.range_m * Eigen::RowVector2d(std::cos(seen.bearing_rad), std::sin(seen.bearing_rad));
}

inline double cross(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace mapproof
