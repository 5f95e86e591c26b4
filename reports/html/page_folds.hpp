#pragma once

#include <cstddef>
#include <set>

#include "reports/model/report.hpp"

namespace mapproof {

/// Of its phrases, bytes.
std::size_t characters_of(const Paragraph& paragraph);

/// On a page 1280 pixels wide, in pixels; what is folded has the height of its fold.
double height_of(const Block& block);

/// Folds parts of a page until it has some fifteen screens, and no more of them than that takes:
/// first what stands behind the first tables and figures of a section, then sections for few
/// readers and for some, then the same of sections that most readers want: figures, tables, the
/// sections themselves. Tables that show what got worse come last of all. The first one of them
/// stays open, as do figures and sections that show it and the first section of a study. O(n) in
/// the blocks of the report, the rows of its tables and its figures.
/// @return The sections of `report` that are folded as a whole.
std::set<const Section*> fold_to_screens(Report& report);

}  // namespace mapproof
