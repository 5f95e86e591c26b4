#pragma once

#include <cstdint>
#include <vector>

#include "reports/diff/svg/svg_tree.hpp"

namespace mapproof {

/// Which elements of two SVG files are the same one.
struct SvgMatch {
  std::vector<int> partner;  ///< Of each element of the baseline, in the current file; -1: removed.
  std::vector<int> back;     ///< The other way; -1: added.
  std::vector<bool>
      is_reordered;  ///< Of the baseline: it is drawn before or after others it was not.
};

/// Matches by id where both files have it, on elements of the same name, unless ids only count
/// ("line2d_7") and to another end; else below matched
/// parents: first equal ones in order, then what lies between them, so that the least differs. One
/// element that is gone leaves the others matched.
/// @note O(n) for files that agree but for little; at most 2^22 pairs of children are compared, the
///       rest is matched in order alone.
SvgMatch match_svgs(const SvgTree& baseline, const SvgTree& current);

}  // namespace mapproof
