#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "render/image/image.hpp"
#include "reports/diff/images/image_changes.hpp"

namespace mapproof {

/// The class of a pixel's difference.
enum class PixelMark : std::uint8_t { kEqual, kNoise, kSmoothed, kChanged };

/// Of 255: the largest difference of a channel of two pixels.
inline int largest_difference(std::uint32_t a, std::uint32_t b) {
  int largest = 0;
  for (const int shift : {16, 8, 0})
    largest = std::max(largest, std::abs(static_cast<int>((a >> shift) & 0xFF) -
                                         static_cast<int>((b >> shift) & 0xFF)));
  return largest;
}

inline constexpr int kTile = 16;  ///< Pixels per side.

using TileMarks = std::array<PixelMark, kTile * kTile>;  ///< Row by row.

/// The marks of an image's pixels, kept for tiles in which some pixel differs.
class ChangeMap {
 public:
  ChangeMap() = default;
  ChangeMap(int width, int height)
      : across_((width + kTile - 1) / kTile),
        down_((height + kTile - 1) / kTile),
        location_(static_cast<std::size_t>(across_) * down_, -1) {}

  int across() const { return across_; }  ///< Tiles per row.
  int down() const { return down_; }

  /// The tile's marks, or null where both images are equal. Tiles are counted row by row.
  const TileMarks* tile(int index) const {
    return location_[index] < 0 ? nullptr : &marks_[location_[index]];
  }
  TileMarks* tile(int index) { return location_[index] < 0 ? nullptr : &marks_[location_[index]]; }

  /// Allocates the tiles that differ, all marks kEqual. @param indices  Each once.
  void keep(const std::vector<int>& indices) {
    marks_.resize(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
      location_[indices[i]] = static_cast<std::int32_t>(i);
  }

 private:
  int across_ = 0;
  int down_ = 0;
  std::vector<std::int32_t> location_;
  std::vector<TileMarks> marks_;
};

/// Groups of tiles that touch, corners too; each group in ascending order of its tiles' indices.
/// @param is_in  One value per tile, row by row.
std::vector<std::vector<int>> tile_groups(int across, std::vector<bool> is_in);

/// The groups of changed pixels of an image, 16 pixels or more apart, of which parts are given one
/// after the other. @note Memory: a bit per tile, and some bytes per changed tile.
class ChangedClusters {
 public:
  explicit ChangedClusters(const ImageSize& size);

  /// Adds rows of tiles. @param marks  Of a part of the image.
  /// @param from, to  Rows of tiles in the part, `to` excluded.
  /// @param at  The row in the image of the part's first.
  void add(const ChangeMap& marks, int from, int to, int at);

  /// Sets the number of clusters and the largest.
  void sum_up(PixelDiff& pixels) const;

 private:
  /// The changed pixels of a tile: their bounds are of the image.
  struct Tile {
    int index = 0;
    std::int64_t pixels = 0;
    int left = 0, top = 0, right = 0, bottom = 0;
  };

  int across_ = 0, down_ = 0;
  std::vector<Tile> tiles_;  ///< In the order of their index.
};

// Of heat maps, whose other pixels are grey.
inline constexpr std::uint32_t kChangedColour = 0xD00000, kNoiseColour = 0xF0C000;

/// An image in pale grey, changes in red, differences explained by noise or anti-aliasing in
/// yellow.
struct HeatMap {
  int width = 0;  ///< 0: there is none.
  int height = 0;
  std::string rows = {};  ///< As PaletteImage::rows, with the numbers of heat_colours().

  /// As 0x00RRGGBB.
  std::uint32_t colour(int x, int y) const;
  double changed_share() const;  ///< Of its pixels.
};

/// The colours of every heat map, by their numbers.
const std::vector<std::uint32_t>& heat_colours();

/// @param marks  Of the upper left part of the image that is shown: as large as both have.
/// @note Parallel over rows of tiles.
HeatMap heat_map(const Image& baseline, const ImageSize& size, const ChangeMap& marks);

/// One pixel for each square of `side` pixels, which is red if one of its pixels is, else yellow if
/// one is, else of their mean grey.
HeatMap reduced(const HeatMap& map, int side);

/// Adds rows `from` to `to` - 1 of a part below `map`, or to an empty one.
void append_rows(const HeatMap& part, int from, int to, HeatMap& map);

/// As a PNG file. @param map  Consumed.
std::string encode_png(HeatMap map);

}  // namespace mapproof
