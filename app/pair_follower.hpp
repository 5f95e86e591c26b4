#pragma once

#include "app/follower.hpp"

namespace mapproof {

/// Follows a table of sightings of range and bearing. Each update is the map of pairs of all looks
/// so far, as map_pairs() makes it.
std::unique_ptr<Follower> pair_follower(const FollowedTable& table);

}  // namespace mapproof
