#include "render/image/png_read.hpp"

#include <stdexcept>
#include <tuple>

#include <gtest/gtest.h>
#include <png.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "render/image/png.hpp"

namespace mapproof::test {
namespace {

/// What libpng is to write.
struct Kind {
  int colour = PNG_COLOR_TYPE_RGB;
  int depth = 8;
  bool is_interlaced = false;
  int filters = PNG_ALL_FILTERS;
};

int channels(int colour) {
  return colour == PNG_COLOR_TYPE_RGB          ? 3
         : colour == PNG_COLOR_TYPE_RGBA       ? 4
         : colour == PNG_COLOR_TYPE_GRAY_ALPHA ? 2
                                               : 1;
}

/// Rows of random samples, packed as PNG has them. Alpha is opaque unless `is_clear`.
std::vector<std::vector<unsigned char>> random_rows(const Kind& kind, int width, int height,
                                                    std::uint64_t seed, bool is_clear) {
  Random random(seed);
  const int bits = channels(kind.colour) * kind.depth * width;
  std::vector<std::vector<unsigned char>> rows(static_cast<std::size_t>(height),
                                               std::vector<unsigned char>((bits + 7) / 8));
  const int step = channels(kind.colour) * kind.depth / 8;
  for (auto& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i] = static_cast<unsigned char>(random.next() >> 40);
      const bool is_alpha = (kind.colour & PNG_COLOR_MASK_ALPHA) != 0 &&
                            static_cast<int>(i) % step >= step - kind.depth / 8;
      if (is_alpha && !is_clear) row[i] = 0xFF;
    }
  return rows;
}

/// Colours (i, 2 i, 255 - i), as far as the depth has them.
std::vector<png_color> palette(int depth) {
  std::vector<png_color> colours;
  for (int i = 0; i < 1 << depth; ++i)
    colours.push_back(
        {static_cast<png_byte>(i), static_cast<png_byte>(2 * i), static_cast<png_byte>(255 - i)});
  return colours;
}

std::string written(const Kind& kind, int width, std::vector<std::vector<unsigned char>> rows) {
  std::string bytes;
  png_structp png = png_create_write_struct(
      PNG_LIBPNG_VER_STRING, nullptr,
      [](png_structp, png_const_charp what) { throw std::runtime_error(what); }, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, std::size_t count) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<char*>(data), count);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(rows.size()),
               kind.depth, kind.colour, kind.is_interlaced ? PNG_INTERLACE_ADAM7 : 0, 0, 0);
  png_set_filter(png, 0, kind.filters);
  const auto colours = palette(std::min(kind.depth, 8));
  if (kind.colour == PNG_COLOR_TYPE_PALETTE)
    png_set_PLTE(png, info, colours.data(), static_cast<int>(colours.size()));
  png_write_info(png, info);
  std::vector<png_bytep> pointers;
  for (auto& row : rows) pointers.push_back(row.data());
  png_write_image(png, pointers.data());
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

/// Sample `c` of pixel `x` of a row, of 2^depth - 1.
unsigned sample(const Kind& kind, const std::vector<unsigned char>& row, int x, int c) {
  const int index = x * channels(kind.colour) + c;
  if (kind.depth == 16) return row[2 * index] << 8u | row[2 * index + 1];
  const int bit = index * kind.depth;
  return (row[bit / 8] >> (8 - kind.depth - bit % 8)) & ((1u << kind.depth) - 1);
}

/// The pixel as PNG's specification has it, over white.
std::uint32_t expected(const Kind& kind, const std::vector<unsigned char>& row, int x) {
  const double most = (1 << kind.depth) - 1;
  const auto value = [&](int c) { return sample(kind, row, x, c) / most; };
  if (kind.colour == PNG_COLOR_TYPE_PALETTE) {
    const png_color colour = palette(kind.depth)[sample(kind, row, x, 0)];
    return static_cast<std::uint32_t>(colour.red << 16 | colour.green << 8 | colour.blue);
  }
  const bool is_grey = (kind.colour & PNG_COLOR_MASK_COLOR) == 0;
  const bool has_alpha = (kind.colour & PNG_COLOR_MASK_ALPHA) != 0;
  const double alpha = has_alpha ? value(channels(kind.colour) - 1) : 1.0;
  std::uint32_t pixel = 0;
  for (int c = 0; c < 3; ++c) {
    const double over = value(is_grey ? 0 : c) * alpha + (1.0 - alpha);
    pixel = pixel << 8 | static_cast<std::uint32_t>(over * 255.0 + 0.5);
  }
  return pixel;
}

/// Rows of a drawing: runs of few colours on flat ground, most rows nearly as the one above.
std::vector<std::vector<unsigned char>> drawn_rows(const Kind& kind, int width, int height,
                                                   std::uint64_t seed) {
  Random random(seed);
  const auto step = static_cast<std::size_t>(channels(kind.colour));
  std::vector<std::vector<unsigned char>> rows(
      1, std::vector<unsigned char>(step * static_cast<std::size_t>(width), 0xFF));
  while (rows.size() < static_cast<std::size_t>(height)) {
    std::vector<unsigned char> row = random.uniform() < 0.1 ? rows.front() : rows.back();
    for (int runs = static_cast<int>(random.uniform(0.0, 4.0)); runs > 0; --runs) {
      const int start = static_cast<int>(random.uniform(0.0, width));
      const int end = std::min(width, start + static_cast<int>(random.uniform(1.0, 60.0)));
      const auto colour = static_cast<unsigned char>(85 * static_cast<int>(random.uniform(0., 4.)));
      for (std::size_t i = step * start; i < step * end; ++i)
        if (step < 4 || i % step != 3) row[i] = static_cast<unsigned char>(colour + i % step);
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

void expect_rows(const Kind& kind, int width, const std::vector<std::vector<unsigned char>>& rows) {
  const PngFile file = read_png(written(kind, width, rows));
  ASSERT_EQ(file.image.width, width);
  ASSERT_EQ(file.image.height, static_cast<int>(rows.size()));
  int wrong = 0;
  for (int y = 0; y < file.image.height; ++y)
    for (int x = 0; x < width; ++x) wrong += file.image.row(y)[x] != expected(kind, rows[y], x);
  EXPECT_EQ(wrong, 0);
}

void expect_read(const Kind& kind, int width, int height, bool is_clear) {
  SCOPED_TRACE(testing::Message() << "colour " << kind.colour << " depth " << kind.depth << " "
                                  << width << " x " << height << " filters " << kind.filters
                                  << " interlaced " << kind.is_interlaced);
  expect_rows(kind, width, random_rows(kind, width, height, 7, is_clear));
}

TEST(PngReader, FindsWhatTheEncoderWrote) {
  Image image{300, 200, {}};
  for (std::uint32_t i = 0; i < 60000; ++i) image.pixels.push_back((i * 2654435761u) >> 8);
  const PngFile file = read_png(encode_png(image, {.dpi = 144, .texts = {{"Title", "é"}}}));
  EXPECT_EQ(file.image.pixels, image.pixels);
  EXPECT_EQ(file.texts.at("Title"), "é");
  EXPECT_EQ(file.pixels_per_metre, 5669u);
  EXPECT_EQ(file.finer_digest, 0u);
}

TEST(PngReader, ReadsEveryKind) {
  for (const auto& [colour, depths] : {std::pair{PNG_COLOR_TYPE_GRAY, std::vector{1, 2, 4, 8, 16}},
                                       {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}},
                                       {PNG_COLOR_TYPE_RGB, {8, 16}},
                                       {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}},
                                       {PNG_COLOR_TYPE_RGBA, {8, 16}}})
    for (const int depth : depths)
      for (const bool is_interlaced : {false, true})
        for (const bool is_clear : {false, true})
          for (const int width : {1, 2, 3, 9, 33})
            expect_read({colour, depth, is_interlaced, PNG_ALL_FILTERS}, width, 11, is_clear);
}

TEST(PngReader, TakesEveryFilterOff) {
  for (const int filter :
       {PNG_FILTER_NONE, PNG_FILTER_SUB, PNG_FILTER_UP, PNG_FILTER_AVG, PNG_FILTER_PAETH})
    for (const int colour : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGBA})
      expect_read({colour, 8, false, filter}, 50, 40, false);
}

TEST(PngReader, TakesEveryFilterOffFlatGroundAndRepeatedRows) {
  for (const int filter : {PNG_FILTER_NONE, PNG_FILTER_SUB, PNG_FILTER_UP, PNG_FILTER_AVG,
                           PNG_FILTER_PAETH, PNG_ALL_FILTERS})
    for (const int colour : {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGBA})
      for (const int width : {1, 7, 50, 203}) {
        const Kind kind{colour, 8, false, filter};
        SCOPED_TRACE(testing::Message()
                     << "colour " << colour << " width " << width << " filter " << filter);
        expect_rows(kind, width, drawn_rows(kind, width, 120, 22));
      }
}

TEST(PngReader, ReadsAPaletteWithItsNumbers) {
  const PaletteImage three{{0xFF0000, 0x00FF00, 0x0000FF}, std::string("\0\0\1\2\0\2\1\0", 8)};
  const PngFile file = read_png(encode_png(three, 3));
  EXPECT_EQ(file.image.pixels, (std::vector<std::uint32_t>{0xFF0000, 0x00FF00, 0x0000FF, 0x0000FF,
                                                           0x00FF00, 0xFF0000}));
  EXPECT_THROW(encode_png(three, 4), InvalidInput);
  EXPECT_THROW(encode_png({{}, three.rows}, 3), InvalidInput);
}

TEST(PngReader, TellsSamplesApartThatEightBitsCannot) {
  const Kind deep{PNG_COLOR_TYPE_GRAY, 16, false, PNG_ALL_FILTERS};
  const PngFile a = read_png(written(deep, 2, {{0x12, 0x12, 0x80, 0x80}}));
  const PngFile b = read_png(written(deep, 2, {{0x12, 0x13, 0x80, 0x80}}));
  EXPECT_EQ(a.image.pixels, b.image.pixels);
  EXPECT_EQ(a.finer_digest, 0u);
  EXPECT_NE(b.finer_digest, 0u);
  const Kind clear{PNG_COLOR_TYPE_GRAY_ALPHA, 8, false, PNG_ALL_FILTERS};
  EXPECT_NE(read_png(written(clear, 1, {{0x00, 0x00}})).finer_digest,
            read_png(written(clear, 1, {{0xFF, 0x00}})).finer_digest);
}

}  // namespace
}  // namespace mapproof::test
