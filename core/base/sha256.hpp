#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace mapproof {

/// SHA-256 [fips180-4].
std::array<std::uint8_t, 32> sha256(std::string_view bytes);

/// The same as 64 hexadecimal digits, small letters.
std::string sha256_hex(std::string_view bytes);

}  // namespace mapproof
