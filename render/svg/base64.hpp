#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// Adds `bytes` in base64 with padding, without line breaks [rfc4648].
void append_base64(std::string& out, std::string_view bytes);

}  // namespace mapproof
