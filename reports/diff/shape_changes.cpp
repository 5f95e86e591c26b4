#include "reports/diff/shape_changes.hpp"

#include <cmath>

namespace mapproof {
namespace {

// Found on the mutations of tests/reports/diff and on pictures by matplotlib with three hints.
constexpr int kFewPixels = 4;      // That tell little of a tile;
constexpr int kShapePixels = 8;    // of its shape,
constexpr int kUnlikePixels = 16;  // and that another thing stands there.
constexpr double kKeptLeft = 0.1;  // Of the difference, what a movement leaves of a kept shape.
constexpr double kMoved = 0.8;     // Pixels,
constexpr double kFar = 1.6;
constexpr double kVeryFar = 1.7;  // which hints move a quarter of all tiles by at most:
constexpr double kVeryFarShare = 0.33;
constexpr double kFarShare = 0.05;  // Where hints are ruled out;
constexpr int kFewestFar = 3;
constexpr double kOppositeShare = 0.1;  // of tiles that went each way.
constexpr double kStill = 0.5;          // Pixels: in place, with kStillLeft of the difference left,
constexpr double kStillLeft = 0.2;
constexpr double kCopiedLeft = 0.01;   // or with next to nothing left wherever it went.
constexpr double kInShapeShare = 0.7;  // Of hints .66, of one digit and all moved a bit .71.
constexpr double kUnlikeLeft = 0.8;
constexpr double kMostUnlikeShare = 0.2;

bool is_moved(const TileEvidence& tile, double px) {
  return tile.kept.left < kKeptLeft && tile.kept.displacement_px() > px;
}

bool is_in_shape(const TileEvidence& tile) {
  return tile.kept.left < kCopiedLeft ||
         (tile.kept.left < kStillLeft && tile.kept.displacement_px() <= kStill);
}

bool is_unlike(const TileEvidence& tile) {
  return tile.beyond_noise >= kUnlikePixels && 2 * tile.bold > tile.beyond_noise &&
         tile.kept.left > kUnlikeLeft && tile.left_share > kUnlikeLeft;
}

/// Labels of axes lie outermost to the left and below, titles and legends at other sides, and other
/// hints touch them all.
bool may_be_hints(const TileBounds& differing, const TileBounds& texture) {
  const bool left = differing.left <= texture.left + 1, top = differing.top <= texture.top + 1;
  const bool right = differing.right >= texture.right - 1;
  const bool bottom = differing.bottom >= texture.bottom - 1;
  return left + top + right + bottom >= 3 || (left && bottom);
}

struct ShapeCounts {
  TileBounds differing;
  int tiles = 0, far = 0, very_far = 0, in_shape = 0, unlike = 0;
  int right = 0, left = 0, down = 0, up = 0;  ///< Tiles that moved so.

  void add(const TileEvidence& tile, int x, int y) {
    if (tile.beyond_noise >= kFewPixels) differing.add(x, y);
    if (tile.beyond_noise < kShapePixels) return;
    ++tiles;
    far += is_moved(tile, kFar);
    very_far += is_moved(tile, kVeryFar);
    in_shape += is_in_shape(tile);
    unlike += is_unlike(tile);
    if (!is_moved(tile, kMoved)) return;
    right += tile.kept.right_px > kStill, left += tile.kept.right_px < -kStill;
    down += tile.kept.down_px > kStill, up += tile.kept.down_px < -kStill;
  }

  /// What is put on whole pixels goes one way, whichever it is.
  bool any_opposite() const {
    return std::max(std::min(right, left), std::min(down, up)) >
           std::max(kOppositeShare * tiles, 1.0);
  }
  bool any_moved(const Texture& texture) const {
    if (very_far > kVeryFarShare * tiles) return true;
    if (may_be_hints(differing, texture.bounds)) return false;
    return (far >= kFewestFar && far > kFarShare * tiles) || any_opposite();
  }
  bool any_unlike() const {
    return in_shape > kInShapeShare * tiles && unlike <= kMostUnlikeShare * tiles;
  }
};

}  // namespace

std::vector<bool> shape_changes(std::span<const int> tiles, std::span<const TileEvidence> evidence,
                                const Texture& texture, int across) {
  ShapeCounts all;
  for (std::size_t i = 0; i < tiles.size(); ++i)
    all.add(evidence[i], tiles[i] % across, tiles[i] / across);
  const bool any_moved = all.any_moved(texture), any_unlike = all.any_unlike();
  std::vector<bool> is_changed(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i)
    is_changed[i] =
        (any_moved && is_moved(evidence[i], kMoved)) || (any_unlike && is_unlike(evidence[i]));
  return is_changed;
}

}  // namespace mapproof
