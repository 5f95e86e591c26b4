#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "render/image/image.hpp"

namespace mapproof {

/// What a PNG file holds.
struct PngFile {
  Image image;  ///< 8 bits a channel, composed over white.
  /// Of what `image` cannot hold: samples finer than 8 bits and colours that are not opaque. 0 if
  /// there are none, so that two files hold the same values if image and digest are equal.
  std::uint64_t finer_digest = 0;
  std::map<std::string, std::string> texts;  ///< Of tEXt and plain iTXt chunks up to 64 KiB.
  unsigned pixels_per_metre = 0;
  bool has_time = false;
};

/// Memory that the pixels of a PNG may take: 2^26 pixels of 4 bytes, so that a file of nothing that
/// unpacks to a great deal does no harm. Interlaced ones take 8 bytes a pixel, 12 if of 16 bits.
inline constexpr std::uint64_t kMostPngBytes = std::uint64_t{1} << 28;

/// Reads any kind of PNG: grey, RGB or palette, alpha, 1 to 16 bits, interlaced. Gamma and colour
/// profiles are not applied. Nothing is allocated for pixels that so few bytes cannot hold.
/// @throws InvalidInput with the reason if png_problem has one, the pixels exceed kMostPngBytes, or
///         the compressed rows are damaged or not exactly as long as the header requires.
/// @note Linear; at most kMostPngBytes of memory.
PngFile read_png(std::string_view bytes);

/// All but the pixels, which are not decoded. @throws InvalidInput as read_png, for what can be
/// found without decoding.
PngFile read_png_remarks(std::string_view bytes);

}  // namespace mapproof
