#pragma once

#include <string>
#include <string_view>

#include "core/base/sha256.hpp"

namespace mapproof {

/// "sha256-…": how a content security policy names an inline script or style sheet.
std::string policy_hash(std::string_view text);

}  // namespace mapproof
