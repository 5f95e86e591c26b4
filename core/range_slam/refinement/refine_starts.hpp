#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"
#include "core/range_slam/known_landmarks.hpp"

namespace mapproof {

/// Dead reckoning, and the landmarks that its path gives.
SlamEstimate dead_reckoning_start(const RangeLog& log);

/// Dead reckoning, and landmarks anywhere within reach of its path.
SlamEstimate random_start(const RangeLog& log, std::uint64_t seed);

/// A path at the times of another one, which leads from each of its poses to the next as odometry
/// does: T poses with headings, not wrapped.
///
/// @param path  n >= 1 poses at any times, with headings or not: without, they are those under
///              which odometry fits the path around. Those of no finite position are left out.
/// @param odometry  T poses, with headings.
/// @throws InvalidInput for a times_problem() of either, a heading that is not finite, or if no
///         pose of `path` is within the time of the odometry.
/// @note O(n + T log n).
Trajectory carried_along(const Trajectory& path, const Trajectory& odometry);

/// A start as refine() begins from it.
struct PlacedStart {
  Trajectory path;     ///< At all of odometry's times.
  Points landmarks_m;  ///< N x 2; NaN rows: no position, or never measured within that time.
  std::optional<KnownLandmarks> known;  ///< What ties the frame; empty: the first pose does.
  std::vector<Status> statuses;         ///< kUndetermined if known landmarks cannot tie it.
};

/// Carries a start along the odometry, estimates the landmarks that it does not hold, and moves all
/// into the frame of the known landmarks where the start places two of them. Known landmarks tie
/// the frame if two are heard that are in different positions; else none of them is held.
/// @param odometry  From dead_reckoned().
/// @param known     Without a known_problem().
/// @throws InvalidInput for what carried_along() or trilaterated() refuse.
PlacedStart placed_start(const RangeLog& log, const Trajectory& odometry, const SlamEstimate& start,
                         const std::optional<KnownLandmarks>& known);

}  // namespace mapproof
