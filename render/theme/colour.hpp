#pragma once

#include <cstdint>
#include <string>

namespace mapproof {

/// An sRGB colour, opaque.
struct Colour {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;

  auto operator<=>(const Colour&) const = default;
};

/// 0xRRGGBB.
constexpr Colour colour(std::uint32_t rgb) {
  return {static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8),
          static_cast<std::uint8_t>(rgb)};
}

/// "#rrggbb".
std::string hex(Colour colour);

/// Relative luminance [wcag22], 0 (black) to 1 (white).
double luminance(Colour colour);

/// Contrast ratio [wcag22], 1 to 21; text needs 4.5, marks need 3.
double contrast(Colour a, Colour b);

/// `share` of `top` over the rest of `below`, mixed in sRGB as the back ends do.
Colour mix(Colour top, Colour below, double share);

}  // namespace mapproof
