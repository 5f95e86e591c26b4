#pragma once

#include <optional>
#include <string>

#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/refinement/key_poses.hpp"
#include "core/range_slam/refinement/refine_options.hpp"

namespace mapproof {

/// Path, landmarks and range scale that agree best with odometry and ranges: nonlinear least
/// squares by Levenberg and Marquardt's steps [agarwal2022], from a start.
///
/// Minimised is half the sum over motions of the whitened squared error, and over ranges of Huber's
/// loss of (scale * distance + offset - range) / sigma. A range between two poses sees both.
///
/// Without known landmarks the first pose stays where the start has it, and covariances are those
/// after a rigid fit of the landmarks; with fewer than two landmark positions, relative to the
/// first pose. Known landmarks tie the frame, to which the start is moved first, if two of them are
/// heard that are in different positions. A mirrored start ends in a mirrored map.
/// @param start  Any path within the time of the odometry, with headings or not; N landmarks, NaN
///               rows: found from that path.
/// @return The path at all of odometry's times. Landmarks without a position: kLandmarkUnseen;
///         kNotConverged at the limit; kUndetermined if known landmarks do not tie the frame, which
///         is then as without them, if covariances are relative to the first pose, or if there are
///         none since some direction is not determined; kFailed if no step could be taken: the
///         start, carried along the odometry and moved to the frame of the known landmarks.
/// @throws InvalidInput if the log has no odometry or no ranges, or a bound is broken: for ranges
///         that check_ranges() refuses, for what carried_along() refuses of the start's path; or if
///         covariances are asked for with more than 1e7 poses times landmarks.
/// @note One thread; the same bits every time. Time is linear in the poses; see
///       docs/methods/measurements.md.
///       From the first call on, what Ceres logs below the level of fatal errors is silenced in the
///       whole process.
SlamEstimate refine(const RangeLog& log, const SlamEstimate& start,
                    const RefineOptions& options = {});

}  // namespace mapproof
