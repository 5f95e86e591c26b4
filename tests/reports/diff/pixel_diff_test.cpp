#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "render/image/png_read.hpp"
#include "reports/diff/images/pixel_diff.hpp"

namespace mapproof::test {
namespace {

/// Strips of 64 rows, whatever the image.
constexpr StripLimits kNarrow{.whole = 0, .strip = 0, .heat = std::int64_t{1} << 24};

Image paper(int width, int height) {
  return {width, height,
          std::vector<std::uint32_t>(static_cast<std::size_t>(width) * height, 0xFFFFFF)};
}

void draw(Image& image, const PixelBox& box, std::uint32_t colour) {
  for (int y = box.y; y < box.y + box.height; ++y)
    std::fill_n(image.row(y) + box.x, box.width, colour);
}

Image rows_of(const Image& image, int from, int count) {
  Image part{image.width, count, {}};
  part.pixels.assign(image.row(from),
                     image.row(from) + static_cast<std::size_t>(count) * image.width);
  return part;
}

struct Found {
  PixelDiff pixels;
  HeatMap heat;
  int strips = 0;
};

Found in_strips(const Image& baseline, const Image& current, const ImageOptions& options = {},
                const StripLimits& limits = kNarrow) {
  StripDiff diff({baseline.width, baseline.height}, {current.width, current.height}, options, true,
                 limits);
  Found found;
  for (int done = 0; const int count = diff.next_rows(); done += count, ++found.strips)
    diff.add(rows_of(baseline, done, count), rows_of(current, done, count));
  found.pixels = diff.pixels();
  found.heat = std::move(diff).heat();
  return found;
}

TEST(StripDiff, FindsADotInAnyRowOnce) {
  const Image white = paper(40, 300);
  for (int y = 0; y < 298; ++y) {
    Image dotted = white;
    draw(dotted, {11, y, 2, 2}, 0);
    const Found found = in_strips(white, dotted);
    ASSERT_EQ(found.strips, 4);
    EXPECT_EQ(found.pixels.changed, 4) << "row " << y;
    EXPECT_EQ(found.pixels.clusters, 1) << "row " << y;
    EXPECT_EQ(found.pixels.largest_cluster, (PixelBox{11, y, 2, 2}));
  }
}

TEST(StripDiff, CountsWhatCrossesAllStripsAsOneCluster) {
  const Image white = paper(64, 400);
  Image lined = white;
  draw(lined, {30, 5, 3, 390}, 0x0000FF);
  const Found found = in_strips(white, lined);
  EXPECT_EQ(found.pixels.changed, 3 * 390);
  EXPECT_EQ(found.pixels.clusters, 1);
  EXPECT_EQ(found.pixels.largest_cluster, (PixelBox{30, 5, 3, 390}));
  EXPECT_DOUBLE_EQ(found.pixels.changed_share, 3.0 * 390 / (64 * 400));
}

TEST(StripDiff, OfOneStripIsTheComparisonOfTheWhole) {
  const std::filesystem::path folder = std::filesystem::path(MAPPROOF_TEST_DATA) / "foreign_images";
  const Image a = read_png(read_file(folder / "gnuplot-wave.200.png")).image;
  const Image b = read_png(read_file(folder / "gnuplot-wave.203.png")).image;
  const PixelComparison whole = pixel_diff(a, b);
  const Found found = in_strips(a, b, {}, {});
  EXPECT_EQ(found.strips, 1);
  EXPECT_EQ(found.pixels.differing, whole.pixels.differing);
  EXPECT_EQ(found.pixels.changed, whole.pixels.changed);
  EXPECT_EQ(found.pixels.antialiased, whole.pixels.antialiased);
  EXPECT_EQ(found.heat.rows, heat_map(a, {a.width, a.height}, whole.marks).rows);
}

TEST(StripDiff, CountsEachIgnoredPixelOnceAndSaysThatOnlyTheyDiffer) {
  const Image white = paper(50, 300);
  Image dotted = white;
  draw(dotted, {10, 60, 10, 100}, 0);
  ImageOptions options;
  options.ignored = {{5, 50, 20, 120}, {5, 50, 20, 10}};
  StripDiff diff({50, 300}, {50, 300}, options, false, kNarrow);
  for (int done = 0; const int count = diff.next_rows(); done += count)
    diff.add(rows_of(white, done, count), rows_of(dotted, done, count));
  EXPECT_EQ(diff.pixels().ignored, 20 * 120);
  EXPECT_EQ(diff.pixels().differing, 0);
  EXPECT_TRUE(diff.differs_where_ignored());
}

TEST(StripDiff, ReducesAHeatMapAndKeepsTheChangeInIt) {
  const Image white = paper(200, 300);
  Image dotted = white;
  draw(dotted, {101, 203, 2, 2}, 0);
  const Found found = in_strips(white, dotted, {}, {.whole = 0, .strip = 0, .heat = 4000});
  EXPECT_EQ(found.heat.width, 50);
  EXPECT_EQ(found.heat.height, 75);
  EXPECT_DOUBLE_EQ(found.heat.changed_share(), 2.0 / (50 * 75));  // Two squares of 4 x 4.
  EXPECT_EQ(found.heat.colour(25, 50), kChangedColour);
}

TEST(StripDiff, ReadsNothingOfImagesOfVeryDifferentSizes) {
  EXPECT_EQ(StripDiff({100, 100}, {100, 200}, {}, true, kNarrow).next_rows(), 0);
}

constexpr int kCellsAcross = 12, kCellsDown = 10;  // Cells.

/// The colour of a cell.
using CellColour = std::function<std::uint32_t(int cell)>;

/// A heat map of cells of `side` pixels in a frame on white paper.
Image heat_map_of(int side, const CellColour& colour) {
  constexpr int kMargin = 30;
  const int width = kCellsAcross * side + 2 * kMargin, height = kCellsDown * side + 2 * kMargin;
  Image image{width, height,
              std::vector<std::uint32_t>(static_cast<std::size_t>(width) * height, 0xFFFFFF)};
  for (int y = kMargin - 1; y <= height - kMargin; ++y)
    for (int x = kMargin - 1; x <= width - kMargin; ++x) {
      const int column = (x - kMargin + side) / side - 1, row = (y - kMargin + side) / side - 1;
      const bool is_cell = column >= 0 && column < kCellsAcross && row >= 0 && row < kCellsDown;
      image.row(y)[x] = is_cell ? colour(row * kCellsAcross + column) : 0;
    }
  return image;
}

/// A colour table from blue to yellow with values from 20 to 230.
std::uint32_t cell_colour(int cell) {
  std::minstd_rand random(static_cast<unsigned>(cell) + 1);
  random.discard(3);
  const auto value = static_cast<std::uint32_t>(random() % 200);
  return (20 + value) << 16 | (230 - value / 2) << 8 | (220 - value);
}

/// The colour with each channel changed by one of the differences, at random.
CellColour rounded(int least, int most) {
  return [=](int cell) {
    std::minstd_rand random(static_cast<unsigned>(cell) + 1000);
    random.discard(3);
    std::uint32_t colour = cell_colour(cell);
    for (const int shift : {16, 8, 0})
      colour += static_cast<std::uint32_t>(
                    least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1)))
                << shift;
    return colour;
  };
}

std::int64_t changed(int side, const CellColour& current) {
  return pixel_diff(heat_map_of(side, cell_colour), heat_map_of(side, current)).pixels.changed;
}

class RoundedColours : public ::testing::TestWithParam<int> {};

TEST_P(RoundedColours, OfTheCellsOfAHeatMapPass) {
  EXPECT_EQ(changed(GetParam(), rounded(-1, 1)), 0);
  EXPECT_EQ(changed(GetParam(), rounded(-2, 2)), 0);
  EXPECT_EQ(changed(GetParam(), rounded(0, 1)), 0) << "floor against nearest";
}

TEST_P(RoundedColours, DoNotHideACellThatChangedByMore) {
  const int side = GetParam();
  const auto one_more = [&](int cell) {
    return rounded(-1, 1)(cell) + (cell == 66 ? 0x0C0000u : 0u);
  };
  EXPECT_GE(changed(side, one_more), side * side / 2);
}

TEST_P(RoundedColours, AreNotALayerOverAllCells) {
  EXPECT_GT(changed(GetParam(), [](int cell) { return cell_colour(cell) + 0x020202; }), 0);
}

INSTANTIATE_TEST_SUITE_P(OfCells, RoundedColours, ::testing::Values(6, 8, 11, 16, 20, 33));

TEST(RoundedColour, OfOneCellAloneIsAChange) {
  EXPECT_EQ(changed(20, [](int cell) { return cell_colour(cell) + (cell == 66 ? 2 : 0); }),
            20 * 20);
}

TEST(RoundedColour, IsNotWhatIsDrawnAcrossCells) {
  const Image before = heat_map_of(20, cell_colour);
  Image after = before;
  for (int y = 60; y < 200; ++y)
    for (int x = 70; x < 230; ++x) after.row(y)[x] += 0x020202;
  EXPECT_GT(pixel_diff(before, after).pixels.changed, 100 * 100);
}

}  // namespace
}  // namespace mapproof::test
