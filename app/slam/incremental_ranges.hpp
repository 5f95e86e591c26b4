#pragma once

#include "app/map/incremental.hpp"

namespace mapproof {

/// Follows a table of ranges that are taken together: step or time, landmark, range in metres. Each
/// update is the spectral map (core/range_slam/factors/online) of all steps so far that have a
/// range to every landmark of the first one. From four anchors on the map is that of known
/// landmarks. `sensor` and `options` of the table do not count.
std::unique_ptr<Follower> range_follower(const FollowedTable& table);

}  // namespace mapproof
