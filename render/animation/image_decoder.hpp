#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace mapproof {

inline constexpr std::int64_t kMostDecodedPixels = std::int64_t{1} << 26;  ///< Of a frame.

/// A frame as a viewer shows it.
struct DecodedFrame {
  int width = 0;
  int height = 0;
  int duration_ms = 0;    ///< 0: the file is one image.
  std::string_view rgba;  ///< Four bytes a pixel, row by row.
};

/// Decodes the frames of an image file by FFmpeg's libraries, on one thread.
/// @param format  apng, bmp, gif, jpeg, tiff or webp.
/// @throws std::runtime_error if FFmpeg has no decoder of the format or the file is damaged;
///         std::bad_alloc.
void decode_image(std::string bytes, std::string_view format,
                  const std::function<void(const DecodedFrame&)>& take);

}  // namespace mapproof
