#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/image/image.hpp"

namespace mapproof {

/// What a pixel's difference is taken for.
enum class PixelMark : std::uint8_t { kEqual, kNoise, kSmoothed, kChanged };

inline constexpr int kTile = 16;  ///< Pixels a side.

using TileMarks = std::array<PixelMark, kTile * kTile>;  ///< Row by row.

/// The marks of a picture's pixels, kept for tiles in which some pixel differs.
class ChangeMap {
 public:
  ChangeMap() = default;
  ChangeMap(int width, int height)
      : across_((width + kTile - 1) / kTile),
        down_((height + kTile - 1) / kTile),
        place_(static_cast<std::size_t>(across_) * down_, -1) {}

  int across() const { return across_; }  ///< Tiles a row.
  int down() const { return down_; }

  /// The tile's marks, or null where both pictures are equal. Tiles are counted row by row.
  const TileMarks* tile(int index) const {
    return place_[index] < 0 ? nullptr : &marks_[place_[index]];
  }
  TileMarks* tile(int index) { return place_[index] < 0 ? nullptr : &marks_[place_[index]]; }

  /// Makes room for the tiles that differ, all of kEqual. @param indices  Each once.
  void keep(const std::vector<int>& indices) {
    marks_.resize(indices.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
      place_[indices[i]] = static_cast<std::int32_t>(i);
  }

 private:
  int across_ = 0;
  int down_ = 0;
  std::vector<std::int32_t> place_;
  std::vector<TileMarks> marks_;
};

/// The picture in pale grey, what changed in red, what noise or smoothing explains in yellow.
/// @param baseline  Taken over.
Image heat_map(Image baseline, const ChangeMap& marks);

}  // namespace mapproof
