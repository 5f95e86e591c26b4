#include "render/image/palette.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// A disc that gets darker towards one side on a plain ground, in one colour or the other.
Image shaded_disc(std::uint32_t ground, int red, int green, int blue) {
  Image image{160, 120, std::vector<std::uint32_t>(160 * 120, ground)};
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      if (std::hypot(x - 80, y - 60) > 50.0) continue;
      const double light = 0.3 + 0.7 * (x - 30) / 100.0;
      const auto channel = [light](int value) {
        return static_cast<std::uint32_t>(std::lround(light * value));
      };
      image.row(y)[x] = channel(red) << 16 | channel(green) << 8 | channel(blue);
    }
  return image;
}

/// The largest difference of a channel between an image and its numbers in a palette.
int greatest_shift(const Image& image, const std::vector<std::uint32_t>& palette,
                   const std::string& rows) {
  int greatest = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const auto code =
          static_cast<unsigned char>(rows[static_cast<std::size_t>(y) * (image.width + 1) + 1 + x]);
      for (const int shift : {0, 8, 16})
        greatest = std::max(greatest, std::abs(static_cast<int>(image.row(y)[x] >> shift & 0xFF) -
                                               static_cast<int>(palette[code] >> shift & 0xFF)));
    }
  return greatest;
}

TEST(TwoPalettes, AreExactForFewColours) {
  const Image first{2, 2, {0xFFFFFF, 0x0072B2, 0x0072B2, 0x1A1A1A}};
  const Image second{2, 2, {0x15181C, 0x4BA6E0, 0x4BA6E1, 0xE6E9ED}};
  const TwoPalettes both = to_two_palettes(first, second);
  EXPECT_EQ(both.first.size(), 4U);  // One colour of the first is two of the second.
  EXPECT_EQ(both.second.size(), 4U);
  EXPECT_EQ(greatest_shift(first, both.first, both.rows), 0);
  EXPECT_EQ(greatest_shift(second, both.second, both.rows), 0);
}

TEST(TwoPalettes, ShiftShadesALittleAndGroundsNotAtAll) {
  // Shades across in the one, and down in the other: more pairs than a palette has.
  Image first = shaded_disc(0xFFFFFF, 200, 220, 240), second = shaded_disc(0x15181C, 70, 90, 120);
  for (int y = 20; y < 100; ++y)
    for (int x = 40; x < 120; ++x) second.row(y)[x] = second.row(y)[x] / 2 & 0x7F7F7F | y / 8;
  const TwoPalettes both = to_two_palettes(first, second);
  EXPECT_LE(both.first.size(), 256U);
  EXPECT_EQ(both.first.size(), both.second.size());
  EXPECT_LE(greatest_shift(first, both.first, both.rows), 24);
  EXPECT_LE(greatest_shift(second, both.second, both.rows), 24);
  const auto corner = static_cast<unsigned char>(both.rows[1]);
  EXPECT_EQ(both.first[corner], 0xFFFFFFU);
  EXPECT_EQ(both.second[corner], 0x15181CU);
}

TEST(TwoPalettes, AreTheSameEachTime) {
  const Image first = shaded_disc(0xFFFFFF, 250, 40, 90), second = shaded_disc(0, 90, 200, 30);
  const TwoPalettes a = to_two_palettes(first, second), b = to_two_palettes(first, second);
  EXPECT_EQ(a.first, b.first);
  EXPECT_EQ(a.second, b.second);
  EXPECT_EQ(a.rows, b.rows);
}

TEST(TwoPalettes, NeedImagesOfOneSize) {
  EXPECT_THROW(to_two_palettes({2, 1, {1, 2}}, {1, 2, {1, 2}}), InvalidInput);
  EXPECT_THROW(to_two_palettes({0, 0, {}}, {0, 0, {}}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
