#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace mapproof {

inline constexpr std::int64_t kMostDecodedPixels = std::int64_t{1} << 28;  ///< Of a frame.
inline constexpr std::int64_t kLargestDecodedSide = 65'535;                ///< In pixels.

/// Why a frame of a size is not decoded; empty: it is.
inline std::string decoded_size_problem(std::int64_t width, std::int64_t height) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels ";
  if (width < 1 || height < 1) return size + "are none";
  if (width > kLargestDecodedSide || height > kLargestDecodedSide)
    return size + "have more than the " + std::to_string(kLargestDecodedSide) +
           " a side that are compared";
  if (width * height > kMostDecodedPixels)
    return size + "are more than the " + std::to_string(kMostDecodedPixels) + " that are compared";
  return "";
}

/// A frame as a viewer shows it.
struct DecodedFrame {
  int width = 0;
  int height = 0;
  int duration_ms = 0;        ///< 0: the file is one image.
  std::uint64_t profile = 0;  ///< A digest of its ICC profile, without date and id; 0: it has none.
  const std::uint8_t* rgba = nullptr;  ///< Four bytes a pixel, row by row,
  std::ptrdiff_t stride = 0;           ///< each so many bytes after the one before.
};

/// Decodes the frames of an image file by FFmpeg's libraries, of animated WebP by libwebp, on one
/// thread.
/// @param format  apng, bmp, gif, jpeg, tiff or webp.
/// @throws std::runtime_error if there is no decoder of the format or the file is damaged;
///         std::bad_alloc.
void decode_image(std::string bytes, std::string_view format,
                  const std::function<void(const DecodedFrame&)>& take);

}  // namespace mapproof
