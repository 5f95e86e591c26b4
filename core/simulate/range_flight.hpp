#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "core/model/space_points.hpp"
#include "core/simulate/range_noise.hpp"

namespace mapproof {

/// A random world in space for range-only SLAM, and a flight through it.
struct RangeFlightOptions {
  Eigen::Index landmarks = 12;  ///< >= 1.
  Eigen::Index steps = 400;     ///< >= 1.
  double half_width_m = 10.0;   ///< Landmarks and flight lie in [-half_width, half_width]^2; > 0.
  double height_m = 8.0;        ///< They lie at [0, height]; > 0, at most 2 half_width.
  double step_m = 1.0;          ///< From one position to the next, > 0, at most height_m / 2.
  double turn_sigma_rad = 0.3;  ///< Of the direction, about each axis, a step; >= 0.
  SimulatedRangeNoise noise = {};
};

struct RangeFlight {
  SpacePoints landmarks_m;   ///< N x 3.
  SpacePoints positions_m;   ///< T x 3.
  Eigen::MatrixXd ranges_m;  ///< N x T, noisy, >= 0.
};

/// Landmarks uniform in the box, a vehicle that flies on in a wavering direction and turns to a
/// random one at the border, and its ranges.
/// @throws InvalidInput if a bound is broken.
/// @note O(N T) time.
RangeFlight simulate_range_flight(const RangeFlightOptions& options, std::uint64_t seed);

}  // namespace mapproof
