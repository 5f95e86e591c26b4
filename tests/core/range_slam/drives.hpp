#pragma once

#include "core/model/range_log.hpp"

namespace mapproof::test {

/// A drive of 200 s at 1 m/s along a path that curves this way and that, with single ranges to six
/// landmarks in turn, 5 a second.
struct Drive {
  RangeLog log;         ///< With the ground truth.
  Trajectory odometry;  ///< The path by odometry, in a frame of its own.
};

struct DriveOptions {
  double range_sigma_m = 0.0;
  double range_scale = 1.0;
  double gyro_drift = 0.0;  ///< rad/s.
};

Drive drive(const DriveOptions& options, std::uint64_t seed);

}  // namespace mapproof::test
