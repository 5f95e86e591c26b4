#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace mapproof {

/// SHA-256 [fips180-4].
std::array<std::uint8_t, 32> sha256(std::string_view bytes);

/// Base64 with padding [rfc4648, section 4].
std::string base64(std::string_view bytes);

/// "sha256-…": how a content security policy names an inline script or style sheet.
std::string policy_hash(std::string_view text);

}  // namespace mapproof
