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

/// The same of an image with shades, in which larger steps would be seen.
inline constexpr int kMostShadeShift = 4;

/// The image with at most 256 colours: exact if it has no more. Otherwise frequent colours stay and
/// rare ones, those of smoothed edges, go to a near one; empty if that took more than `most_shift`
/// of 255 in some channel.
std::optional<PaletteImage> to_palette(const Image& image, int most_shift = kMostColourShift);

/// Two images that show the same in other colours, as numbers of pairs of colours.
struct TwoPalettes {
  std::vector<std::uint32_t> first, second;  ///< 0x00RRGGBB, 1 to 256 pairs.
  std::string rows;                          ///< As in PaletteImage.
};

/// Both images with at most 256 pairs of colours: exact if they have no more, else by cutting the
/// box of all pairs where it is widest [heckbert1982]. The most frequent pair of each box stays, so
/// that grounds keep their colours.
/// @throws InvalidInput if the images differ in size or have no pixels.
TwoPalettes to_two_palettes(const Image& first, const Image& second);

}  // namespace mapproof
