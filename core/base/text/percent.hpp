#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text/ascii.hpp"

namespace mapproof {

/// The text with every byte that does not stay as %XX.
/// @param stays  Whether a byte stays as it is.
template <typename Stays>
std::string percent_encoded(std::string_view text, const Stays& stays) {
  std::string encoded;
  for (const char c : text)
    encoded += stays(c) ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return encoded;
}

/// Whether a byte is a letter or a digit of ASCII, or one of `more`.
constexpr bool is_plain(char c, std::string_view more) {
  return is_letter(c) || is_digit(c) || more.find(c) != std::string_view::npos;
}

}  // namespace mapproof
