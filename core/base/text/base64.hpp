#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// Adds `bytes` in base64 with padding, without line breaks [rfc4648, section 4].
void append_base64(std::string& out, std::string_view bytes);

/// The same alone.
std::string base64(std::string_view bytes);

}  // namespace mapproof
