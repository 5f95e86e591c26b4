#pragma once

#include <optional>
#include <string>

#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/refinement/key_poses.hpp"

namespace mapproof {

struct EkfOptions {
  OdometryNoise odometry = {};   ///< Of one motion.
  double range_sigma_m = 0.5;    ///< > 0.
  double gate = 9.0;             ///< Squared sigmas beyond which a range is left out; > 0.
  double range_scale = 1.0;      ///< Measured range over distance, > 0: at first, or throughout.
  double scale_sigma = 0.0;      ///< Of that first guess, >= 0; 0: it is held.
  double initial_way_m = 50.0;   ///< Driven before a landmark is given its first position; > 0.
  double initial_sigma_m = 3.0;  ///< Worst standard deviation of a first position; > 0.
  std::optional<KnownLandmarks> known = std::nullopt;
  Eigen::Index covariances = 0;  ///< Poses with one, evenly spread; 0: no covariances at all.

  /// Names the first field that cannot be used with n landmarks; empty if none.
  std::string problem(Eigen::Index n) const;
};

/// A baseline: the extended Kalman filter over the robot's pose and the landmarks [thrun2005],
/// each motion of the odometry a prediction, each range an update at its time unless it is gated
/// out.
///
/// A landmark that is not known takes its first position from its measurements so far, trilaterated
/// along the filter's own path, once that way is driven and the position is certain enough; these
/// measurements are then used up. It starts with the covariance of the pose plus that of the
/// measurements, and uncorrelated with both. Poses are the estimates of the filter at their time:
/// nothing is smoothed.
/// @return The path at all of odometry's times; statuses: landmarks that never got a position
///         (kLandmarkUnseen); most of the updates gated out, so that the filter is lost
///         (kNotConverged).
/// @throws InvalidInput if the log has no odometry, more than 500 landmarks, or a bound is broken.
/// @note O(N^2) time per range and motion, O(N^2) memory.
SlamEstimate ekf_slam(const RangeLog& log, const EkfOptions& options = {});

}  // namespace mapproof
