#pragma once

#include "core/model/points.hpp"

namespace mapproof {

/// Mean orientation error: the share, in percent, of landmark triples that turn the other way
/// round than in the truth [yairi2007, section 4.1]. Triples on one line in the truth, to
/// 1e-12 of the sine at their first landmark, do not count; a triple that the estimate flattens
/// counts as wrong.
///
/// @param truth, estimate  n x 2, finite, row by row the same landmarks.
/// @return NaN if there is no triple to judge.
/// @throws InvalidInput if the sizes differ.
/// @note O(n^3) time.
double orientation_error_percent(const Points& truth, const Points& estimate);

}  // namespace mapproof
