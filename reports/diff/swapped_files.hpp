#pragma once

#include <span>
#include <vector>

#include "reports/diff/diff_result.hpp"

namespace mapproof {

/// Adds to the causes of items whose current file is, byte by byte, the baseline's file of another
/// item: swapped, or renamed. What was swapped is at least changed, whatever drew it.
void name_swapped(std::vector<DiffItem>& items, std::span<const Verdict> allowed);

}  // namespace mapproof
