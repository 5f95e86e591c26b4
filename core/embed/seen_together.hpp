#pragma once

#include <optional>

#include "core/graph/neighbours.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// Tells whether neighbours were chosen among landmarks of which the observations say nothing.
///
/// @param nearest  K or more of each landmark, nearest first (see nearest_neighbours).
/// @param apart  The distance of landmarks never seen together; infinite: there are no such.
/// @return kArbitraryNeighbours, with how many landmarks have such neighbours among their first K,
///         and into how many pieces the graph falls without them; empty if none has, or
///         if all others are neighbours.
/// @note O(n K log n).
std::optional<Status> arbitrary_neighbours(const NeighbourLists& nearest, int neighbours,
                                           double apart);

/// How many groups the landmarks fall into if those seen together belong to one.
/// @param squared_distances  n x n; those of `apart_squared` or more are of landmarks never seen
///                           together. Infinite `apart_squared`: 1.
/// @note O(n^2).
int groups_seen_together(const Eigen::MatrixXd& squared_distances, double apart_squared);

}  // namespace mapproof
