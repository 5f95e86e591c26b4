#pragma once

#include <algorithm>
#include <climits>
#include <span>
#include <vector>

#include "reports/diff/images/tile_evidence.hpp"

namespace mapproof {

/// The outermost of some tiles, counted from the upper left one.
struct TileBounds {
  int left = INT_MAX, top = INT_MAX, right = INT_MIN, bottom = INT_MIN;

  void add(int x, int y) {
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  }
};

/// What is drawn in a picture.
struct Texture {
  int tiles = 0;      ///< That are not of one colour.
  TileBounds bounds;  ///< Of those with ink that stands out of noise.
};

/// Of a picture that differs all over, the tiles that no other hints and no other smoothing
/// explains: those that moved by a pixel and more and kept their shape, if many did or if what
/// differs does not reach out as text does; and those that did not keep it, where most did.
///
/// @param tiles   Numbers of the tiles that differ; `evidence` is theirs.
/// @param across  Tiles a row.
/// @param allowed_px  How far a piece may be moved.
/// @return One each of `tiles`.
std::vector<bool> shape_changes(std::span<const int> tiles, std::span<const TileEvidence> evidence,
                                const Texture& texture, int across, double allowed_px);

}  // namespace mapproof
