#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/figures/maps/map.hpp"
#include "render/image/png.hpp"
#include "render/image/png_read.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/images/baselines.hpp"
#include "tests/support/images/image_difference.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

Figure map_to_compare() { return map_figure(sample_map(20, 0.15, 2), "map"); }

Image drawn(const Figure& figure) { return to_image(lay_out(figure, baseline_theme())); }

/// The image of the usual map after a change to what is drawn.
template <typename Change>
Image changed_map(Change change) {
  Drawing drawing = lay_out(map_to_compare(), baseline_theme());
  change(drawing);
  return to_image(drawing);
}

Image shifted(const Image& image, int by) {
  Image moved = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = by; x < image.width; ++x) moved.row(y)[x] = image.row(y)[x - by];
  return moved;
}

bool alike(const Image& a, const Image& b) { return is_alike(image_difference(a, b)); }

TEST(ImageComparison, ADrawingIsLikeItself) {
  const ImageDifference difference =
      image_difference(drawn(map_to_compare()), drawn(map_to_compare()));
  EXPECT_TRUE(difference.same_size);
  EXPECT_EQ(difference.changed_share, 0.0);
  EXPECT_EQ(difference.structure, 1.0);
}

TEST(ImageComparison, ForgivesSlightlyOtherSmoothing) {
  const Image image = drawn(map_to_compare());
  Image other = image;
  for (std::uint32_t& pixel : other.pixels)
    if ((pixel & 0xFF) > 8 && (pixel & 0xFF) < 0xF0) pixel -= 4;
  EXPECT_TRUE(alike(image, other));
}

TEST(ImageComparison, SeesAnotherSize) {
  Image wide = drawn(map_to_compare());
  Image narrow = wide;
  --narrow.height;
  EXPECT_FALSE(alike(wide, narrow));
  EXPECT_FALSE(alike({}, {}));
}

TEST(ImageComparison, SeesAShiftOfOnePixel) {
  const Image image = drawn(map_to_compare());
  EXPECT_FALSE(alike(image, shifted(image, 1)));
}

TEST(ImageComparison, SeesAMissingMarker) {
  const Image missing = changed_map([](Drawing& drawing) {
    const auto marker = std::ranges::find(drawing.items, ItemClass::kMarker, &Item::item_class);
    drawing.items.erase(marker);
  });
  EXPECT_FALSE(alike(drawn(map_to_compare()), missing));
}

TEST(ImageComparison, SeesSwappedColours) {
  ErrorCurveSpec spec = sample_curves(2, 1);
  const Image image = drawn(error_curve_figure(spec));
  Figure swapped = error_curve_figure(spec);
  for (Layer& layer : swapped.panels[0].layers)
    if (auto* line = std::get_if<Polyline>(&layer))
      line->colour =
          line->colour == ThemeColour::kSeries1 ? ThemeColour::kSeries2 : ThemeColour::kSeries1;
  EXPECT_FALSE(alike(image, drawn(swapped)));
}

TEST(ImageComparison, SeesOneMarkerOfAnotherColour) {
  const Image recoloured = changed_map([](Drawing& drawing) {
    for (auto item = drawing.items.rbegin(); item != drawing.items.rend(); ++item)
      if (auto* stamp = std::get_if<Stamp>(&item->what);
          stamp && item->item_class == ItemClass::kMarker) {
        Shape symbol = drawing.symbols[stamp->symbol];
        symbol.fill = colour(0x009E73);
        drawing.symbols.push_back(symbol);
        stamp->symbol = drawing.symbols.size() - 1;
        return;
      }
  });
  EXPECT_FALSE(alike(drawn(map_to_compare()), recoloured));
}

TEST(ImageComparison, SeesADroppedLegendEntry) {
  const Image dropped = changed_map([](Drawing& drawing) {
    const auto text = std::ranges::find(drawing.items, ItemClass::kLegendText, &Item::item_class);
    drawing.items.erase(text);
  });
  EXPECT_FALSE(alike(drawn(map_to_compare()), dropped));
}

TEST(ImageComparison, SeesAnotherDigit) {
  Figure other = map_to_compare();
  other.notes[0].text.replace(other.notes[0].text.find("4.70"), 4, "4.76");
  EXPECT_FALSE(alike(drawn(map_to_compare()), drawn(other)));
}

TEST(PngEncoder, KeepsImagesOfFewColoursExactly) {
  Image image{7, 5, {}};
  for (int i = 0; i < 35; ++i) image.pixels.push_back(0x010203u * static_cast<unsigned>(i));
  EXPECT_EQ(read_png(encode_png(image)).image.pixels, image.pixels);
}

TEST(PngEncoder, KeepsImagesOfVeryManyColoursExactly) {
  Image image{300, 300, {}};
  for (std::uint32_t i = 0; i < 90000; ++i) image.pixels.push_back((i * 2654435761u) >> 8);
  EXPECT_FALSE(to_palette(image).has_value());
  EXPECT_EQ(read_png(encode_png(image)).image.pixels, image.pixels);
}

TEST(PngEncoder, MakesNoStepsOfShades) {
  Image image{100, 10, {}};  // 1000 colours, neighbours 6 apart.
  for (std::uint32_t i = 0; i < 1000; ++i)
    image.pixels.push_back(6 * (i / 100) << 16 | 6 * (i / 10 % 10) << 8 | 6 * (i % 10));
  EXPECT_TRUE(to_palette(image).has_value());
  EXPECT_FALSE(to_palette(image, kMostShadeShift).has_value());
  EXPECT_NE(read_png(encode_png(image)).image.pixels, image.pixels);
  EXPECT_EQ(read_png(encode_png(image, {.shaded = true})).image.pixels, image.pixels);
}

TEST(PngEncoder, MovesNoChannelOfADrawingNoticeably) {
  for (const Figure& figure : sample_figures()) {
    const Image image = to_image(lay_out(figure, report_theme()));
    const Image kept = read_png(encode_png(image)).image;
    ASSERT_EQ(kept.pixels.size(), image.pixels.size());
    int most = 0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      for (const int shift : {16, 8, 0})
        most = std::max(most, std::abs(static_cast<int>((image.pixels[i] >> shift) & 0xFF) -
                                       static_cast<int>((kept.pixels[i] >> shift) & 0xFF)));
    EXPECT_LE(most, kMostColourShift) << figure.id;
  }
}

TEST(PngEncoder, WritesTheSmallestImage) {
  EXPECT_EQ(read_png(encode_png({1, 1, {0xABCDEF}})).image.pixels[0], 0xABCDEFu);
}

TEST(PngEncoder, RefusesAnImageWithoutItsPixels) {
  EXPECT_THROW(encode_png({0, 5, {}}), InvalidInput);
  EXPECT_THROW(encode_png({4, 4, {1, 2, 3}}), InvalidInput);
  try {
    encode_png({30000, 30000, {}});
    FAIL() << "rows of 2.7e9 bytes";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("2^31 - 1"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace mapproof::test
