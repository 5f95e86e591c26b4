#pragma once

#include <vector>

#include "core/model/points.hpp"

namespace mapproof {

/// The four landmarks furthest out along the diagonals of the extent, all different, ascending;
/// rows with NaN are left out.
std::vector<Eigen::Index> diagonal_anchors(const Points& ground_truth_m);

}  // namespace mapproof
