#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/base/random.hpp"
#include "core/model/points.hpp"
#include "core/model/range_log.hpp"

namespace mapproof {

/// The errors of simulated ranges.
struct SimulatedRangeNoise {
  double sigma_m = 0.0;      ///< Standard deviation of a range, m, >= 0.
  double share = 0.0;        ///< The same as a share of the range, >= 0; both add as variances.
  double correlation = 0.0;  ///< Of errors to one landmark one step apart, in [0, 1).
};

/// Ranges of landmarks at positions, with noise, none below 0.
/// @param landmarks_m  N x d.
/// @param positions_m  T x d.
/// @return N x T.
/// @throws InvalidInput if a bound of the noise is broken, or dimensions disagree.
Eigen::MatrixXd simulated_ranges(const Eigen::MatrixXd& landmarks_m,
                                 const Eigen::MatrixXd& positions_m,
                                 const SimulatedRangeNoise& noise, Random& random);

/// A random world in space for range-only SLAM, and a flight through it.
struct RangeFlightOptions {
  Eigen::Index landmarks = 12;  ///< >= 1.
  Eigen::Index steps = 400;     ///< >= 1.
  double half_width_m = 10.0;   ///< Landmarks and flight lie in [-half_width, half_width]^2; > 0.
  double height_m = 8.0;        ///< They lie at [0, height]; > 0, at most 2 half_width.
  double step_m = 1.0;          ///< From one position to the next, > 0, at most height_m / 2.
  double heading_change_sigma_rad = 0.3;  ///< Of the direction, about each axis, a step; >= 0.
  SimulatedRangeNoise noise = {};
};

struct RangeFlight {
  SpacePoints landmarks_m;   ///< N x 3.
  SpacePoints positions_m;   ///< T x 3.
  Eigen::MatrixXd ranges_m;  ///< N x T, noisy, >= 0.
};

/// Landmarks uniform in the box, a vehicle that flies on in a random-walk direction and turns to a
/// random one at the border, and its ranges.
/// @throws InvalidInput if a bound is broken.
/// @note O(N T) time.
RangeFlight simulate_range_flight(const RangeFlightOptions& options, std::uint64_t seed);

/// A random world for range-only SLAM [boots2013, figure 1]. What the paper does not give is ours.
struct RangeWorldOptions {
  Eigen::Index landmarks = 6;  ///< >= 1.
  Eigen::Index steps = 500;    ///< >= 1.
  double half_width_m = 10.0;  ///< Landmarks and path lie in [-half_width, half_width]^2; > 0.
  double step_m = 1.0;         ///< From one position to the next, > 0, at most half_width_m.
  double heading_change_sigma_rad = 0.5;  ///< Of the heading from step to step, >= 0.
  double noise_m = 0.0;                   ///< Standard deviation of a range, m, >= 0.
  double noise_share = 0.01;  ///< The same as a share of the range, >= 0; both add as variances.
  double noise_correlation = 0.0;  ///< Of errors to one landmark one step apart, in [0, 1).
};

struct RangeWorld {
  Points landmarks_m;           ///< N x 2.
  Points positions_m;           ///< T x 2.
  Eigen::VectorXd heading_rad;  ///< T: of the motion to the next position.
  Eigen::MatrixXd ranges_m;     ///< N x T, noisy, >= 0.
};

/// Landmarks uniform in the area, a robot that walks on in a random-walk direction and turns to a
/// random one at the border, and its ranges.
/// @throws InvalidInput if a bound is broken.
/// @note O(N T) time.
RangeWorld simulate_range_world(const RangeWorldOptions& options, std::uint64_t seed);

/// A simulated drive of a robot on wheels among landmarks, with single ranges to them in any order.
struct RangeDriveOptions {
  int landmarks = 6;              ///< >= 1.
  int steps = 2000;               ///< Motions, each .2 s and .2 m long; >= 2.
  double half_width_m = 30;       ///< Landmarks and path lie in [-half_width, half_width]^2.
  double forward_sigma_m = 0.02;  ///< Of one motion, forward; none sideways.
  double heading_change_sigma_rad = 0.005;  ///< Of its heading change.
  double range_sigma_m = 0.5;
  double range_every_s = 0.25;
  double range_scale = 1.0;
  double correlation = 0.0;     ///< Of half the variance of the errors to one landmark, a second
                                ///< apart, in [0, 1).
  double offset_sigma_m = 0.0;  ///< Of a constant in each landmark's ranges.
};

/// What is wrong with a drive; each from its middle on, or about it. 0: nothing.
struct DriveFaults {
  double common_offset_m = 0.0;
  double landmark_offset_m = 0.0;  ///< Of landmark 0.
  double late_s = 0.0;
  double jump_s = 0.0;
  double moved_m = 0.0;          ///< Landmark 0.
  double exchanged_share = 0.0;  ///< Of the second half: IDs of landmarks 0 and 1.
  double gap_s = 0.0;            ///< Odometry is missing.
  double frozen_s = 0.0;         ///< Odometry reports a standstill.
  double outlier_share = 0.0;    ///< Ranges that may have any length up to the longest.
};

/// The log with its ground truth.
/// @throws InvalidInput for a drive without landmarks or motions.
RangeLog simulate_drive(const RangeDriveOptions& options, const DriveFaults& faults,
                        Random& random);

}  // namespace mapproof
