#pragma once

#include "core/base/random.hpp"
#include "core/model/experiment.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// Scatters landmarks uniformly over the room, kept apart by the stated gaps.
/// @throws InvalidInput if they do not fit (a thousand tries for one landmark, ten fresh starts).
World scatter_landmarks(const WorldOptions& options, Random& random);

/// The landmarks nearest the room's corners, all different, ascending; beyond four, those nearest
/// to points spread evenly along the walls. At most as many as there are landmarks.
std::vector<Eigen::Index> corner_anchors(const World& world, int count);

}  // namespace mapproof
