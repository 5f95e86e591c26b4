#include "core/base/text/windows_1252.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include "core/base/text/utf8.hpp"

namespace mapproof {
namespace {

/// The characters 0x80 to 0x9F; 0: not defined. All others are those of Unicode.
constexpr std::array<char32_t, 32> kUpperControls = {
    0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017D, 0,      0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};

}  // namespace

std::size_t ascii_length(std::string_view text) {
  std::size_t at = 0;
  for (std::uint64_t word = 0; at + sizeof word <= text.size(); at += sizeof word) {
    std::memcpy(&word, text.data() + at, sizeof word);
    if ((word & 0x8080808080808080U) != 0) break;
  }
  while (at < text.size() && static_cast<unsigned char>(text[at]) < 0x80) ++at;
  return at;
}

bool is_windows_1252(std::string_view text) {
  constexpr std::size_t kLongestCharacter = 4;
  std::string_view rest = text.substr(ascii_length(text));
  // A character that is cut off may be either.
  if (rest.empty()) return false;
  if (rest.size() >= kLongestCharacter) return !take_code_point(rest);
  std::string_view begun = rest;
  if (take_code_point(begun)) return false;
  // Followed by ASCII it is whole, and not UTF-8.
  return ascii_length(rest.substr(1)) > 0;
}

std::string from_windows_1252(std::string_view text) {
  std::string utf8;
  utf8.reserve(text.size() + text.size() / 8);
  for (const char byte : text) {
    const auto code = static_cast<unsigned char>(byte);
    const bool is_upper_control = code >= 0x80 && code < 0xA0;
    const char32_t character = is_upper_control ? kUpperControls[code - 0x80U] : code;
    if (is_upper_control && character == 0)
      utf8 += byte;
    else
      append_utf8(utf8, character);
  }
  return utf8;
}

}  // namespace mapproof
