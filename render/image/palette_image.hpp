#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/image/image.hpp"

namespace mapproof {

/// An image as numbers of colours.
struct PaletteImage {
  std::vector<std::uint32_t> colours;  ///< 0x00RRGGBB, 1 to 256 of them.
  std::string rows;  ///< A zero (PNG's filter "none") and a byte a pixel, row by row.
};

/// How far a channel of a pixel may be moved so that 256 colours are enough.
inline constexpr int kMostColourShift = 12;

/// The image with at most 256 colours: exact if it has no more. Otherwise frequent colours stay and
/// rare ones, those of smoothed edges, go to a near one; empty if that took more than
/// kMostColourShift of 255 in some channel.
std::optional<PaletteImage> to_palette(const Image& image);

}  // namespace mapproof
