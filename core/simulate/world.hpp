#pragma once

#include "core/base/random.hpp"
#include "core/model/experiment.hpp"
#include "core/model/world.hpp"
#include "core/model/world_options.hpp"

namespace mapproof {

/// Scatters landmarks uniformly over the room, kept apart by the stated gaps.
/// @throws InvalidInput if they do not fit (a thousand tries for one landmark, ten fresh starts).
World scatter_landmarks(const WorldOptions& options, Random& random);

/// The landmarks whose true position is given, all different, ascending; at most as many as there
/// are landmarks. kWalls: nearest to the corners with four, nearest to points spread evenly along
/// the walls with more or fewer; kRandom: any; kCluster: nearest the room's first corner.
/// @param random  Drawn from for kRandom alone.
std::vector<Eigen::Index> place_anchors(const World& world, int count, AnchorPlacement placement,
                                        Random& random);

}  // namespace mapproof
