#pragma once

#include <set>

#include "reports/model/report.hpp"

namespace mapproof {

/// Folds what few readers open, until a page has some fifteen screens: secondary tables, then
/// figures behind the first ones of each gallery, then whole sections. What got worse stays open.
/// O(n) in the blocks of the report and their figures.
/// @return The sections of `report` that are folded as a whole.
std::set<const Section*> fold_to_screens(Report& report);

}  // namespace mapproof
