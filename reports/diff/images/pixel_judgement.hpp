#pragma once

#include <algorithm>
#include <climits>
#include <span>
#include <vector>

#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/tile_evidence.hpp"

namespace mapproof {

/// The bounds of a set of tiles, counted from the upper left one.
struct TileBounds {
  int left = INT_MAX, top = INT_MAX, right = INT_MIN, bottom = INT_MIN;

  void add(int x, int y) {
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  }
};

/// The extent of the drawing in an image.
struct Texture {
  int tiles = 0;      ///< Tiles with more than one colour.
  TileBounds bounds;  ///< Of the tiles with contrast above the noise.
};

/// In an image that differs everywhere, finds the tiles that neither hinting nor anti-aliasing
/// explains. These are tiles that moved by a pixel or more and kept their shape, if there are many
/// or if the differing region does not extend as far as text does; and tiles that did not keep
/// their shape, where most did.
/// @param tiles  Indices of the tiles that differ, in the order of `evidence`.
/// @param across  Tiles per row.
/// @param allowed_px  The allowed movement of a part.
/// @return One value per element of `tiles`.
std::vector<bool> shape_changes(std::span<const int> tiles, std::span<const TileEvidence> evidence,
                                const Texture& texture, int across, double allowed_px);

/// Decides which differences are changes, and marks their pixels so.
///
/// Different anti-aliasing, different hinting or a small shift of everything affect edges
/// everywhere in an image. A few groups of tiles in an otherwise equal image are therefore changes,
/// unless a small movement explains them. Where an image differs everywhere, only differences that
/// anti-aliasing cannot cause are changes: lost or new shapes, movements beyond half a pixel,
/// different colours, different means of flat regions, and the tiles that shape_changes() finds.
/// @param tiles  Indices of the tiles that differ, in the order of `evidence`.
/// @param texture   Of the baseline.
void judge(std::span<const int> tiles, std::span<const TileEvidence> evidence,
           const Texture& texture, const ImageOptions& options, ChangeMap& marks);

}  // namespace mapproof
