#include "core/base/out_of_memory.hpp"

#include <algorithm>

#include "core/base/errors.hpp"

namespace mapproof {

OutOfMemory::OutOfMemory(const std::string& path) noexcept {
  std::string words = kOutOfMemory;
  try {
    words += ": " + printable(path, words_.size() / 2);
  } catch (const std::bad_alloc&) {
    words = kOutOfMemory;  // Without the path.
  }
  words.resize(std::min(words.size(), words_.size() - 1));
  std::ranges::copy(words, words_.begin());
}

}  // namespace mapproof
