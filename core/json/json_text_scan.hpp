#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace mapproof {

/// Functions on the text of JSON that was checked.
namespace json_text_scan {

/// The offset behind blanks.
std::uint32_t skip_blanks(std::string_view text, std::uint32_t offset);
/// The offset behind the string, number, word or empty container that begins here.
std::uint32_t skip_plain(std::string_view text, std::uint32_t offset);
/// The string with its quotes that begins here, decoded.
std::string decoded(std::string_view quoted);

}  // namespace json_text_scan

}  // namespace mapproof
