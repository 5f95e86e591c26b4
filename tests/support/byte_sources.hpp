#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "core/base/files/byte_source.hpp"

namespace mapproof::test {

/// Bytes in memory that come in pieces of at most `piece`.
inline ByteSource source_of(std::string bytes, std::size_t piece = std::size_t{1} << 16,
                            std::string name = "source") {
  return {std::move(name),
          [bytes = std::move(bytes), at = std::size_t{0}, piece](std::span<char> to) mutable {
            const std::size_t count = std::min({to.size(), piece, bytes.size() - at});
            bytes.copy(to.data(), count, at);
            at += count;
            return count;
          }};
}

}  // namespace mapproof::test
