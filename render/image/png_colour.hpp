#pragma once

#include <string>
#include <vector>

#include "render/image/png_chunks.hpp"

namespace mapproof {

/// The colour space that a PNG's values are in, as its chunks say: cICP before iCCP before sRGB
/// before gAMA with cHRM [PNG specification, third edition, 4.3]. A file without them is in sRGB.
struct PngColour {
  std::string label = "sRGB";  ///< For readers.
  std::string content = {};    ///< Equal in equal spaces; empty: sRGB.
};

/// @param chunks  Of png_chunks().
PngColour png_colour(const std::vector<PngChunk>& chunks);

}  // namespace mapproof
