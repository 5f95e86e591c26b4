// Images that FFmpeg's libraries and libwebp decode, in mapproof-animation.
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "core/base/errors.hpp"
#include "render/animation/image_decoder.hpp"
#include "render/decode/image_reader.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"

namespace mapproof::fuzz {
namespace {

std::string_view name_of(DecodedFormat format) {
  switch (format) {
    case DecodedFormat::kApng: return "apng";
    case DecodedFormat::kBmp: return "bmp";
    case DecodedFormat::kGif: return "gif";
    case DecodedFormat::kJpeg: return "jpeg";
    case DecodedFormat::kTiff: return "tiff";
    case DecodedFormat::kWebp: return "webp";
    default: return "";
  }
}

/// Every frame has a size within the limit, and pixels that can be read.
void decode(std::string_view bytes) {
  const std::optional<DecodedFormat> format = decoded_format(bytes);
  const std::string_view name = format ? name_of(*format) : "";
  if (name.empty()) throw InvalidInput("no image that the program decodes");
  try {
    decode_image(std::string(bytes), name, [](const DecodedFrame& frame) {
      if (frame.width < 1 || frame.height < 1 ||
          std::int64_t{frame.width} * frame.height > kMostDecodedPixels)
        found("a frame has a size within the limit",
              std::to_string(frame.width) + " " + std::to_string(frame.height));
      // A copy is checked whole by the sanitizer, in a fraction of the time of its bytes alone.
      std::vector<std::uint8_t> row(4 * static_cast<std::size_t>(frame.width));
      for (int y = 0; y < frame.height; ++y)
        std::memcpy(row.data(), frame.rgba + y * frame.stride, row.size());
    });
  } catch (const std::runtime_error&) {  // The program's answer.
  }
}
// A frame of the largest size takes 1 GiB, and is converted to another.
const Added kImage({.name = "image",
                    .run = decode,
                    .seeds = {"image_formats/before", "image_formats/after"},
                    .memory = std::size_t{4} << 30});

}  // namespace
}  // namespace mapproof::fuzz
