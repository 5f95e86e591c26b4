#pragma once

#include <vector>

#include "reports/diff/diff_result.hpp"

namespace mapproof {

/// Adds to the causes of items whose current file is, byte by byte, the baseline's file of another
/// item: swapped, or renamed.
void name_swapped(std::vector<DiffItem>& items);

}  // namespace mapproof
