#pragma once

#include <vector>

#include "core/model/trial_study.hpp"

namespace mapproof {

/// Which pairs most triangles speak against: with the other two sides measured, no third is longer
/// than both together, nor shorter than their difference.
///
/// A triangle speaks against its sides if it fails to close by more than `slack` of the longest. A
/// pair is named if more than half of its triangles do, and two or more.
/// @param pairs  As pair_map takes them; `landmarks` of them.
/// @return As many as pairs.
/// @note O(pairs * landmarks) time.
std::vector<bool> against_triangles(const std::vector<MeasuredPair>& pairs, Eigen::Index landmarks,
                                    double slack = 0.25);

}  // namespace mapproof
