#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/image/image.hpp"
#include "render/image/palette.hpp"

namespace mapproof {

struct PngOptions {
  double dpi = 72.0;
  bool shaded = false;  ///< With shades, of which a palette of few colours would make steps.
  std::vector<std::pair<std::string, std::string>>
      texts;  ///< Keyword (1 to 79 of ASCII) and UTF-8.
};

/// The image as a PNG file, with a palette if to_palette() finds one, else as RGB. Texts are
/// iTXt chunks if they need it, tEXt otherwise. No time, the same bytes each time.
/// @throws InvalidInput if a side is below 1 or above 100 000, the pixels are too few, or the rows
///         as RGB exceed 2^31 - 1 bytes.
std::string encode_png(const Image& image, const PngOptions& options = {});

/// The image as a PNG file, with its palette.
/// @throws InvalidInput if a side is below 1 or above 100 000, or the rows are not whole.
std::string encode_png(const PaletteImage& image, int width, const PngOptions& options = {});

/// The data of a palette's chunk: three bytes a colour.
std::string png_palette(std::span<const std::uint32_t> colours);

/// The texts of PngOptions as chunks, as encode_png() writes them after the header.
std::string png_texts(const std::vector<std::pair<std::string, std::string>>& texts);

}  // namespace mapproof
