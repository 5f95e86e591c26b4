#pragma once

#include <optional>
#include <vector>

#include "core/graph/neighbours.hpp"

namespace mapproof {

/// Groups of nodes of a directed graph that no list of a member leaves (closed strong components),
/// each ascending, in the order of their lowest node.
/// @note O(nodes + edges) time.
std::vector<std::vector<Eigen::Index>> closed_groups(const NeighbourLists& lists);

/// Opens all closed groups but one: the shortest distance that leaves a group becomes an edge,
/// until one group is left.
/// @return How many edges were added; empty, with `lists` as they became, if a group has no finite
///         distance out of it.
std::optional<int> open_closed_groups(NeighbourLists& lists, const Eigen::MatrixXd& distances);

/// Joins the sets of neighbours where they fall apart: a landmark that its own neighbours' sets do
/// not reach, through sets that have a landmark in common, joins its own set. After that all are in
/// one piece if the graph of the lists is.
/// @return How many landmarks joined their own set.
int join_sets(NeighbourLists& lists);

}  // namespace mapproof
