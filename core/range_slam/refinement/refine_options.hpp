#pragma once

#include <optional>
#include <string>

#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/refinement/key_poses.hpp"

namespace mapproof {

struct RefineOptions {
  OdometryNoise odometry = {};    ///< Of one motion.
  double range_sigma_m = 0.5;     ///< > 0.
  double huber = 1.5;             ///< Sigmas beyond which a range counts less; > 0.
  bool estimate_scale = true;     ///< One factor for all ranges; else that of the start.
  double offset_sigma_m = 0.0;    ///< Prior of a constant in a landmark's ranges; 0: none.
  double spacing_m = 0.0;         ///< Way between the poses that are estimated; 0: all.
  double coarse_spacing_m = 5.0;  ///< That of a first, cheaper solve; 0: none.
  std::optional<KnownLandmarks> known = std::nullopt;  ///< Held where they are; two or more.
  int most_iterations = 200;                           ///< >= 1.
  /// Poses with a covariance, evenly spread; 0: no covariances at all. With at most 500 landmarks.
  Eigen::Index covariances = 0;

  /// Names the first field that cannot be used with n landmarks; empty if none.
  std::string problem(Eigen::Index n) const;
};

}  // namespace mapproof
