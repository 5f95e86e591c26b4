#include "render/image/png_chunks.hpp"

#include "core/base/errors.hpp"

namespace mapproof {

std::uint32_t big_endian(std::string_view bytes) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(0, 4)) value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

std::vector<PngChunk> png_chunks(std::string_view bytes) {
  std::vector<PngChunk> chunks;
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = big_endian(bytes.substr(at));
    chunks.push_back(
        {bytes.substr(at + 4, 4), bytes.substr(at + 8, length), bytes.substr(at, length + 12)});
    at += length + 12;
  }
  return chunks;
}

PngHeader png_header(const PngChunk& chunk) {
  if (chunk.data.size() != 13) throw InvalidInput("its header is not a PNG header");
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(chunk.data[i]); };
  const PngHeader header{big_endian(chunk.data),
                         big_endian(chunk.data.substr(4)),
                         byte(8),
                         byte(9),
                         byte(10),
                         byte(11),
                         byte(12)};
  const int depth = header.depth, colour = header.colour;
  const bool whole_bytes = depth == 8 || depth == 16;
  const bool fine = depth == 1 || depth == 2 || depth == 4;
  const bool kind = colour == 0   ? fine || whole_bytes
                    : colour == 3 ? fine || depth == 8
                                  : (colour == 2 || colour == 4 || colour == 6) && whole_bytes;
  if (!kind || header.compression != 0 || header.filter != 0 || header.interlace > 1 ||
      header.width == 0 || header.height == 0)
    throw InvalidInput("its header is not a PNG header");
  return header;
}

}  // namespace mapproof
