#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace mapproof {

/// A canonical prefix code as DEFLATE [rfc1951] wants it.
struct PrefixCode {
  std::vector<std::uint8_t> lengths;  ///< Bits of each symbol; 0: it does not occur.
  std::vector<std::uint16_t> codes;   ///< First bit lowest.
};

/// A short code for symbols of those counts, none longer than `limit` bits. A single symbol gets
/// one bit; two at least are needed for the code to be complete.
PrefixCode prefix_code(std::span<const std::uint32_t> counts, int limit);

}  // namespace mapproof
