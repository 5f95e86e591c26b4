#pragma once

#include "core/base/random.hpp"
#include "core/model/walk_options.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// Walks at random from a random free pose [yairi2007, section 4.1]: at each observation the robot
/// changes its heading by a uniform angle and goes one step that way; before a wall or a landmark
/// it takes the smallest heading change that frees its way.
///
/// @param observations  N >= 1, the first at the initial pose.
/// @throws InvalidInput if no free initial pose is found in 10,000 tries.
/// @note O(N M step_m / substep_m) time for M landmarks, up to 182 times that where the robot has
///         to turn; every position is checked against every landmark.
/// @note A robot that no heading change frees turns about on the spot and stays where it is for
///         that step.
Path random_walk(const World& world, const WalkOptions& options, int observations, Random& random);

}  // namespace mapproof
