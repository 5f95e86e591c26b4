#pragma once

#include <cstddef>

namespace mapproof {

/// Asks Linux for huge pages of memory that nothing was written to yet, if it has 4 MB or more: far
/// fewer have to be provided as it is filled.
/// @note Of 2000 landmarks, distances of bits take 0.036 s instead of 0.062 s with them.
void prefer_huge_pages(void* begin, std::size_t bytes);

}  // namespace mapproof
