#pragma once

#include <algorithm>
#include <climits>
#include <span>
#include <vector>

#include "reports/diff/images/change_map.hpp"
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

/// Groups of tiles that touch, corners too; each group in the order of its tiles' numbers.
/// @param is_in  One a tile, row by row.
std::vector<std::vector<int>> tile_groups(int across, std::vector<bool> is_in);

/// Decides which differences are changes, and marks their pixels so.
///
/// Another way of smoothing, other hints or a small shift of everything touch edges all over a
/// picture. A few groups of tiles in one that else is equal are therefore changes unless a small
/// movement explains them; of what differs all over, only that counts which smoothing cannot do:
/// things lost or new, movements beyond half a pixel, other inks, other means of flat regions,
/// and what shape_changes finds.
///
/// @param tiles     Numbers of the tiles that differ; `evidence` is theirs.
/// @param texture   Of the baseline.
void judge(std::span<const int> tiles, std::span<const TileEvidence> evidence,
           const Texture& texture, const PictureOptions& options, ChangeMap& marks);

}  // namespace mapproof
