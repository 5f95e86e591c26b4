#pragma once

#include <cstddef>

namespace mapproof {

/// Visits the ties among sorted values: the first and the end of each, and the mean of their ranks;
/// a value that ties with no other is one of its own. @param same  Of two indices.
template <typename Same, typename Visit>
void for_each_tie(std::size_t values, const Same& same, const Visit& visit) {
  for (std::size_t first = 0, end = 0; first < values; first = end) {
    for (end = first + 1; end < values && same(first, end);) ++end;
    visit(first, end, 0.5 * static_cast<double>(first + 1 + end));
  }
}

}  // namespace mapproof
