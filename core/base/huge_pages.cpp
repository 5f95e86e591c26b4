#include "core/base/huge_pages.hpp"

#include <sys/mman.h>

#include <memory>

namespace mapproof {

void prefer_huge_pages(void* begin, std::size_t bytes) {
  constexpr std::size_t kLeast = std::size_t{4} << 20;
  constexpr std::size_t kHugePage = std::size_t{2} << 20;
  if (bytes < kLeast || std::align(kHugePage, kHugePage, begin, bytes) == nullptr) return;
  ::madvise(begin, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);  // If not, the pages are small.
}

}  // namespace mapproof
