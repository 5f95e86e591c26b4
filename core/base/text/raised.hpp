#pragma once

#include <array>
#include <cstdlib>
#include <string>

namespace mapproof {

/// "⁻⁷": the digits of an exponent, raised.
inline std::string raised(int exponent) {
  constexpr std::array kDigits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent)))
    text += kDigits[static_cast<std::size_t>(digit - '0')];
  return text;
}

}  // namespace mapproof
