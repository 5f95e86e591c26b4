#pragma once

#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// Of the rows 0 to n - 1 `count`, or all if they are fewer: ascending, evenly spread, the first
/// and the last one among them; the first alone for a count of 1.
/// @throws InvalidInput if either is negative.
std::vector<Eigen::Index> spread_rows(Eigen::Index n, Eigen::Index count);

}  // namespace mapproof
