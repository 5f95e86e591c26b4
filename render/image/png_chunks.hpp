#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace mapproof {

inline constexpr std::string_view kPngSignature = "\x89PNG\r\n\x1A\n";

struct PngChunk {
  std::string_view type;  ///< "IHDR"
  std::string_view data;
  std::string_view whole;  ///< With length, type and checksum.
};

/// The first four bytes as a number. @pre There are four.
std::uint32_t big_endian(std::string_view bytes);

/// The chunks of a PNG file that png_problem() accepts.
std::vector<PngChunk> png_chunks(std::string_view bytes);

/// IHDR.
struct PngHeader {
  std::uint32_t width = 0, height = 0;
  int depth = 0;   ///< Bits a sample.
  int colour = 0;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGB and alpha.
  int compression = 0, filter = 0, interlace = 0;

  int channels() const { return colour == 2 ? 3 : colour == 4 ? 2 : colour == 6 ? 4 : 1; }
};

/// @throws InvalidInput if the chunk is not a header that the PNG specification allows.
PngHeader png_header(const PngChunk& chunk);

}  // namespace mapproof
