#pragma once

#include <cstdint>
#include <vector>

#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/image_changes.hpp"

namespace mapproof {

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

}  // namespace mapproof
