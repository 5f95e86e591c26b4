#include "reports/diff/images/image_diff.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/figures/maps/map.hpp"
#include "render/image/png.hpp"
#include "render/plot/layout.hpp"
#include "render/svg/svg.hpp"
#include "tests/support/images/baselines.hpp"
#include "tests/support/samples/sample_figures.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

Image white(int width, int height) {
  return {width, height,
          std::vector<std::uint32_t>(static_cast<std::size_t>(width) * height, 0xFFFFFF)};
}

/// A white image with a dark square of 20 pixels at (30, 30).
Image with_square(std::uint32_t colour = 0x203040) {
  Image image = white(100, 90);
  for (int y = 30; y < 50; ++y) std::fill_n(image.row(y) + 30, 20, colour);
  return image;
}

class ImageDiffTest : public ::testing::Test {
 protected:
  ImageDiff diff(std::string_view a, std::string_view b, const ImageOptions& options = {}) {
    return image_diff(folder_.file("a", a), folder_.file("b", b), options);
  }
  TemporaryFolder folder_;
};

TEST_F(ImageDiffTest, EqualBytesAreIdentical) {
  const std::string png = encode_png(with_square());
  const ImageDiff found = diff(png, png);
  EXPECT_EQ(found.state, ImageState::kIdentical);
  EXPECT_EQ(found.baseline_bytes, png.size());
}

/// The image as libpng writes it, with zlib and filters and without a palette.
std::string recompressed(const Image& image) {
  std::vector<unsigned char> samples;
  for (const std::uint32_t pixel : image.pixels)
    for (const int shift : {16, 8, 0})
      samples.push_back(static_cast<unsigned char>(pixel >> shift));
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.width);
  header.height = static_cast<png_uint_32>(image.height);
  header.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&header, nullptr, &size, 0, samples.data(), 0, nullptr);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&header, bytes.data(), &size, 0, samples.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

TEST_F(ImageDiffTest, AnotherCompressionIsIdentical) {
  const std::string ours = encode_png(with_square()), other = recompressed(with_square());
  EXPECT_NE(ours, other);
  const ImageDiff found = diff(ours, other);
  EXPECT_EQ(found.state, ImageState::kIdentical);
  ASSERT_TRUE(found.pixels);
  EXPECT_EQ(found.pixels->differing, 0);
  EXPECT_EQ(diff(ours, recompressed(with_square(0x203041))).state, ImageState::kDifferent);
}

TEST_F(ImageDiffTest, OtherTextsAreIdenticalPixels) {
  const ImageDiff texts =
      diff(encode_png(with_square(), {.texts = {{"Software", "one"}}}),
           encode_png(with_square(), {.dpi = 90, .texts = {{"mapproof:renderer", "two"}}}));
  EXPECT_EQ(texts.state, ImageState::kIdentical);
  EXPECT_EQ(texts.baseline_renderer, "one");
  EXPECT_EQ(texts.current_renderer, "two");
}

TEST_F(ImageDiffTest, ReportsSizesThatDiffer) {
  const ImageDiff found = diff(encode_png(white(10, 8)), encode_png(white(8, 10)));
  EXPECT_EQ(found.state, ImageState::kDifferent);
  EXPECT_EQ(found.pixels->current, (ImageSize{8, 10}));
  EXPECT_EQ(found.reason,
            "10 x 8 pixels became 8 x 10; in the part that both have the pixels are equal");
  const ImageDiff far = diff(encode_png(white(100, 90)), encode_png(white(100, 107)));
  EXPECT_EQ(far.reason, "100 x 90 pixels became 100 x 107");
}

TEST_F(ImageDiffTest, ComparesTheCommonPartOfSizesThatDifferByAFewPixels) {
  Image wider = white(103, 92);
  for (int y = 30; y < 50; ++y) std::fill_n(wider.row(y) + 40, 20, 0x203040U);
  const auto a = folder_.file("a.png", encode_png(with_square()));
  const auto b = folder_.file("b.png", encode_png(wider));
  const ImageDiff found = image_diff(a, b);
  EXPECT_EQ(found.state, ImageState::kDifferent);
  EXPECT_EQ(found.pixels->current, (ImageSize{103, 92}));
  EXPECT_EQ(found.pixels->changed, 400);
  EXPECT_NE(found.reason.find("in the part that both have 400 pixels changed"), std::string::npos)
      << found.reason;
  const HeatMap heat = heat_map(a, b);
  EXPECT_EQ((ImageSize{heat.width, heat.height}), (ImageSize{100, 90}));
}

TEST_F(ImageDiffTest, LocatesTheLargestClusterOfAChange) {
  const ImageDiff found = diff(encode_png(white(100, 90)), encode_png(with_square()));
  EXPECT_EQ(found.state, ImageState::kDifferent);
  EXPECT_EQ(found.pixels->changed, 400);
  EXPECT_EQ(found.pixels->clusters, 1);
  EXPECT_EQ(found.pixels->largest_cluster, (PixelBox{30, 30, 20, 20}));
  EXPECT_LT(found.pixels->least_structure, 0.1);
  EXPECT_GT(found.pixels->largest_colour_difference, 0.5);
}

TEST_F(ImageDiffTest, IgnoresPixelsInABoxButIsThenNotIdentical) {
  const ImageOptions boxed{.ignored = {{25, 25, 30, 30}}};
  const ImageDiff found = diff(encode_png(white(100, 90)), encode_png(with_square()), boxed);
  EXPECT_EQ(found.state, ImageState::kWithinTolerance);
  EXPECT_EQ(found.pixels->ignored, 900);
  EXPECT_EQ(found.reason, "900 pixels ignored, which differ");
  EXPECT_EQ(diff(encode_png(with_square()), encode_png(with_square()), boxed).state,
            ImageState::kIdentical);
  EXPECT_EQ(diff(encode_png(white(100, 90)), encode_png(with_square()),
                 {.ignored = {{25, 25, 24, 24}, {-5, 80, 900, 900}}})
                .state,
            ImageState::kDifferent);
}

TEST_F(ImageDiffTest, WhiteThatBecameCreamIsNotIdentical) {
  EXPECT_EQ(diff(encode_png(white(100, 90)),
                 encode_png(Image{100, 90, std::vector<std::uint32_t>(9000, 0xFFFDF8)}))
                .state,
            ImageState::kDifferent);
}

TEST_F(ImageDiffTest, AShareOfChangedPixelsMayBeTolerated) {
  const std::string a = encode_png(white(100, 90)), b = encode_png(with_square());
  EXPECT_EQ(diff(a, b, {.changed_share = 0.05}).state, ImageState::kWithinTolerance);
  EXPECT_EQ(diff(a, b, {.changed_share = 0.01}).state, ImageState::kDifferent);
}

TEST_F(ImageDiffTest, OptionsOutOfBoundsAreRefused) {
  const std::string png = encode_png(white(4, 4));
  EXPECT_THROW(diff(png, png, {.ignored = {{0, 0, 0, 5}}}), InvalidInput);
  EXPECT_THROW(diff(png, png, {.noise = -1}), InvalidInput);
  EXPECT_THROW(diff(png, png, {.changed_share = 2}), InvalidInput);
}

TEST_F(ImageDiffTest, AMissingFileIsAnError) {
  EXPECT_THROW(image_diff(folder_ / "none.png", folder_ / "none.png"), IoError);
}

TEST_F(ImageDiffTest, ComparesSvgsByTheirElements) {
  Drawing drawing = lay_out(map_figure(sample_map(20, 0.15, 2), "map"), baseline_theme());
  const std::string before = to_svg(drawing);
  EXPECT_EQ(diff(before, before + "\n").state, ImageState::kIdentical);
  drawing.items.pop_back();
  const ImageDiff found = diff(before, to_svg(drawing));
  EXPECT_EQ(found.state, ImageState::kDifferent);
  ASSERT_TRUE(found.svg);
  EXPECT_GE(found.svg->total, 1);
}

TEST_F(ImageDiffTest, AHeatMapShowsWhatChanged) {
  const auto a = folder_.file("a.png", encode_png(white(100, 90)));
  const auto b = folder_.file("b.png", encode_png(with_square()));
  const HeatMap map = heat_map(a, b);
  EXPECT_EQ(map.width, 100);
  EXPECT_EQ(map.colour(40, 40), 0xD00000u);
  EXPECT_EQ(map.colour(10, 10), 0xFFFFFFu);
  EXPECT_EQ(heat_map(a, a).width, 0);
}

TEST(PixelComparison, TheSmallestImagesCanBeCompared) {
  EXPECT_EQ(pixel_diff({}, {}).pixels.differing, 0);
  EXPECT_EQ(pixel_diff({1, 1, {0}}, {1, 1, {0xFFFFFF}}).pixels.differing, 1);
  EXPECT_EQ(pixel_diff({1, 1, {0}}, {1, 1, {0xFFFFFF}}).pixels.changed, 1);
}

}  // namespace
}  // namespace mapproof::test
