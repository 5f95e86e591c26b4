#pragma once

#include <optional>
#include <string>

#include "core/model/range_log.hpp"
#include "core/model/slam.hpp"
#include "core/range_slam/key_poses.hpp"
#include "core/range_slam/known_landmarks.hpp"

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
  Eigen::Index covariances = 0;  ///< Poses with a covariance, evenly spread; 0: no
                                 ///< covariances at all.

  /// Names the first field that cannot be used with n landmarks; empty if none.
  std::string problem(Eigen::Index n) const;
};

/// Path, landmarks and range scale that agree best with odometry and ranges: nonlinear least
/// squares by Levenberg and Marquardt's steps [agarwal2022], from a start.
///
/// Minimised is half the sum over motions of the whitened squared error, and over ranges of Huber's
/// loss of (scale * distance + offset - range) / sigma. A range between two poses sees both.
///
/// Without known landmarks the first pose stays where the start has it, and covariances are
/// relative to it; known ones tie the frame, to which the start is moved first. A mirrored start
/// ends in a mirrored map.
/// @param start  Any path within the time of the odometry, with headings or not; N landmarks, NaN
///               rows: found from that path.
/// @return The path at all of odometry's times. Landmarks without a place: kLandmarkUnseen;
///         kNotConverged at the limit; kUndetermined and no covariances if some direction is not
///         determined; kFailed, with the start as it came, if no step could be taken.
/// @throws InvalidInput if the log has no odometry or no ranges, or a bound is broken; or if
///         covariances are asked for with more than 500 landmarks or 1e7 poses times landmarks.
/// @note One thread; the same bits every time. Time is linear in the poses; see docs/methods.md.
SlamEstimate refine(const RangeLog& log, const SlamEstimate& start,
                    const RefineOptions& options = {});

}  // namespace mapproof
