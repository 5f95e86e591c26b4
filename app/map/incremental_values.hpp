#pragma once

#include "app/map/incremental.hpp"

namespace mapproof {

/// Follows a table of one sensor's values: step, landmark, value.
std::unique_ptr<Follower> value_follower(const FollowedTable& table);

}  // namespace mapproof
