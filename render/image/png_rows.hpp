#pragma once

#include <optional>
#include <string_view>

#include "render/image/image.hpp"
#include "render/image/png_chunks.hpp"

namespace mapproof {

/// Whether quick_rows can read such a picture: 8 bits a sample, not interlaced,
/// not grey with alpha. Whoever calls looks for tRNS.
bool has_quick_rows(const PngHeader& header);

/// The pixels of the compressed rows, in a third of libpng's time and without a second buffer.
/// @param palette  PLTE's bytes; colours beyond it are black.
/// @return Empty if some pixel is not opaque.
/// @throws InvalidInput if the rows are damaged or not as long as the header says.
/// @pre has_quick_rows(header); width and height are within bounds.
std::optional<Image> quick_rows(const PngHeader& header, std::string_view compressed,
                                std::string_view palette);

}  // namespace mapproof
