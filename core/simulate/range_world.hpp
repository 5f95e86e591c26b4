#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// A random world for range-only SLAM [boots2013, figure 1]. What the paper does not give is ours.
struct RangeWorldOptions {
  Eigen::Index landmarks = 6;   ///< >= 1.
  Eigen::Index steps = 500;     ///< >= 1.
  double half_width_m = 10.0;   ///< Landmarks and path lie in [-half_width, half_width]^2; > 0.
  double step_m = 1.0;          ///< From one position to the next, > 0, at most half_width_m.
  double turn_sigma_rad = 0.5;  ///< Of the heading from step to step, >= 0.
  double noise_m = 0.0;         ///< Standard deviation of a range, m, >= 0.
  double noise_share = 0.01;    ///< The same as a share of the range, >= 0; both add as variances.
  double noise_correlation = 0.0;  ///< Of errors to one landmark one step apart, in [0, 1).
};

struct RangeWorld {
  Points landmarks_m;           ///< N x 2.
  Points positions_m;           ///< T x 2.
  Eigen::VectorXd heading_rad;  ///< T: of the motion to the next position.
  Eigen::MatrixXd ranges_m;     ///< N x T, noisy, >= 0.
};

/// Landmarks uniform in the area, a robot that walks on in a wavering direction and turns to a
/// random one at the border, and its ranges.
/// @throws InvalidInput if a bound is broken.
/// @note O(N T) time.
RangeWorld simulate_range_world(const RangeWorldOptions& options, std::uint64_t seed);

}  // namespace mapproof
