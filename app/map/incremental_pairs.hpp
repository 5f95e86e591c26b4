#pragma once

#include "app/map/incremental.hpp"

namespace mapproof {

/// Follows a table of detections of range and bearing. Each update is the map of pairs of all scans
/// so far, as map_pairs() makes it.
std::unique_ptr<Follower> pair_follower(const FollowedTable& table);

}  // namespace mapproof
