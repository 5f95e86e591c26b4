#include "render/image/png_read.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/image/png.hpp"

namespace mapproof::test {
namespace {

Image grid(int width, int height) {
  Image image{width, height, {}};
  for (int i = 0; i < width * height; ++i)
    image.pixels.push_back((static_cast<std::uint32_t>(i) * 2654435761u) >> 8);
  return image;
}

TEST(PngReader, FindsWhatTheEncoderWrote) {
  const Image image = grid(300, 200);
  const PngFile file = read_png(encode_png(image, {.dpi = 144, .texts = {{"Title", "é"}}}));
  EXPECT_EQ(file.image.pixels, image.pixels);
  EXPECT_EQ(file.texts.at("Title"), "é");
  EXPECT_EQ(file.pixels_per_metre, 5669u);
  EXPECT_EQ(file.finer_digest, 0u);
}

}  // namespace
}  // namespace mapproof::test
