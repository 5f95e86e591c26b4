#pragma once

#include <string>
#include <string_view>

#include "core/base/sha256.hpp"

namespace mapproof {

/// Base64 with padding [rfc4648, section 4].
std::string base64(std::string_view bytes);

/// "sha256-…": how a content security policy names an inline script or style sheet.
std::string policy_hash(std::string_view text);

}  // namespace mapproof
