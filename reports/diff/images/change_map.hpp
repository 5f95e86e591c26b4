#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "render/image/image.hpp"

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

// Of heat maps, whose other pixels are grey.
inline constexpr std::uint32_t kChangedColour = 0xD00000, kNoiseColour = 0xF0C000;

/// The image in pale grey, changes in red, differences explained by noise or anti-aliasing in
/// yellow.
/// @param baseline  Consumed.
Image heat_map(Image baseline, const ChangeMap& marks);

}  // namespace mapproof
