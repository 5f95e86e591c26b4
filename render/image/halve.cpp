#include "render/image/halve.hpp"

namespace mapproof {

Image halved(const Image& image) {
  Image half{image.width / 2, image.height / 2, {}};
  half.pixels.reserve(static_cast<std::size_t>(half.width) * half.height);
  for (int y = 0; y < half.height; ++y) {
    const std::uint32_t* above = image.row(2 * y);
    const std::uint32_t* below = image.row(2 * y + 1);
    for (int x = 0; x < half.width; ++x) {
      std::uint32_t pixel = 0;
      for (const int shift : {0, 8, 16}) {
        std::uint32_t sum = 2;
        for (const std::uint32_t p :
             {above[2 * x], above[2 * x + 1], below[2 * x], below[2 * x + 1]})
          sum += p >> shift & 0xFF;
        pixel |= sum / 4 << shift;
      }
      half.pixels.push_back(pixel);
    }
  }
  return half;
}

}  // namespace mapproof
