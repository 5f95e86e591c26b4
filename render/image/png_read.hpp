#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "render/image/image.hpp"
#include "render/image/png_chunks.hpp"
#include "render/image/png_colour.hpp"

namespace mapproof {

/// What a PNG file holds.
struct PngFile {
  PngHeader header;
  Image image;  ///< 8 bits a channel, composed over white.
  /// Of what `image` cannot hold: samples finer than 8 bits and colours that are not opaque. 0 if
  /// there are none, so that two files hold the same values if image and digest are equal.
  std::uint64_t finer_digest = 0;
  PngColour colour;
  std::map<std::string, std::string> texts;  ///< Of tEXt and plain iTXt chunks up to 64 KiB.
  unsigned pixels_per_metre = 0;
  bool has_time = false;
};

/// Memory that the pixels of a PNG may take that is held whole: 2^26 pixels of 4 bytes, so that a
/// file of nothing that unpacks to a great deal does no harm. Interlaced ones take 8 bytes a pixel,
/// 12 if of 16 bits. A larger image is read in strips: ImageReader in render/decode.
inline constexpr std::uint64_t kMostPngBytes = std::uint64_t{1} << 28;

/// Of any PNG, as of images in other formats: two of them are compared in a minute of CPU time
/// (0.19 s for each million of their pixels). 64 rows are no more than 2^26 pixels.
inline constexpr std::uint64_t kMostPngPixels = std::uint64_t{1} << 28;
inline constexpr std::uint32_t kMostPngWidth = 1U << 20;

/// Whether the pixels fit into kMostPngBytes.
bool is_held_whole(const PngHeader& header);

/// Reads any kind of PNG: grey, RGB or palette, alpha, 1 to 16 bits, interlaced. Gamma and colour
/// profiles are not applied. Nothing is allocated for pixels that so few bytes cannot hold.
/// @throws InvalidInput with the reason if png_problem has one, the image is not held whole, or the
///         compressed rows are damaged or not exactly as long as the header requires.
/// @note Linear; at most kMostPngBytes of memory.
PngFile read_png(std::string_view bytes);

/// All but the pixels, which are not decoded. @throws InvalidInput as read_png, for what can be
/// found without decoding, but of an image that is not held whole only beyond kMostPngPixels and
/// kMostPngWidth.
PngFile read_png_remarks(std::string_view bytes);

}  // namespace mapproof
