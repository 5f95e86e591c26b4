#pragma once

#include <vector>

#include "core/base/random.hpp"
#include "core/model/range_log.hpp"

namespace mapproof {

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
