#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mapproof {

/// Adds `bytes` in base64 with padding, without line breaks [rfc4648, section 4].
void append_base64(std::string& out, std::string_view bytes);

/// The same alone.
std::string base64(std::string_view bytes);

/// The bytes of such a text, in which white space is passed over; empty if it is not one.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace mapproof
