#include "reports/diff/images/shape_changes.hpp"

namespace mapproof {
namespace {

// Found on the mutations of tests/reports/diff and on pictures by matplotlib with three hints.
constexpr int kFewShapePixels = 4;    // That tell little of a tile;
constexpr int kShapePixels = 8;       // of its shape.
constexpr double kKeptLeft = 0.1;     // Of the difference, what a movement leaves of a kept shape.
constexpr double kMoved = 0.45;       // Pixels beyond what a piece may be moved.
constexpr double kCopiedLeft = 0.01;  // Next to nothing: what stands on whole pixels did so before.
constexpr double kStill = 0.15;       // The same: in place,
constexpr double kStillLeft = 0.2;    // with so much of the difference left.

// Where hints may be the cause.
constexpr double kVeryFar = 1.35;       // Pixels beyond, which hints move
constexpr double kVeryFarShare = 0.33;  // a quarter of all tiles by at most.
constexpr double kInShapeShare = 0.7;   // Hints .66.
constexpr int kUnlikePixels = 16;
constexpr double kUnlikeLeft = 0.85;

// Where they are not, and smoothing is the other cause, which leaves in place.
constexpr double kFar = 0.7;        // Pixels beyond, not by whole ones.
constexpr double kFarShare = 0.02;  // Smoothing .004,
constexpr int kFewestFar = 3;
constexpr double kAstray = 0.35;  // Pixels beyond, also of a marker on a line, which stays:
constexpr double kAstrayLeft = 0.3;
constexpr double kAstrayShare = 0.1;    // of tiles went each of two opposite ways.
constexpr double kInPlaceShare = 0.45;  // Where smoothing leaves shapes unlike, .42.
constexpr int kOddPixels = 12;
constexpr double kOddLeft = 0.55;
constexpr double kOddLeftShare = 0.8;
constexpr double kOddEnergy = 1000.0;  // Squares of 255 a pixel beyond noise.
constexpr double kOddCopied = 0.35;    // Of the pixels beyond noise: more are of what moved by one.

constexpr double kMostUnlikeShare = 0.2;

bool is_moved(const TileEvidence& tile, double px) {
  return tile.kept.left < kKeptLeft && tile.kept.displacement_px() > px;
}

bool is_off(const TileEvidence& tile, double allowed_px) {
  return tile.kept.left < kAstrayLeft && tile.kept.displacement_px() > allowed_px + kAstray;
}

bool is_in_place(const TileEvidence& tile, double allowed_px) {
  return tile.kept.left < kStillLeft && tile.kept.displacement_px() <= allowed_px + kStill;
}

/// Whether another thing stands there than one that is hinted otherwise.
bool is_unlike(const TileEvidence& tile) {
  return tile.beyond_noise >= kUnlikePixels && 2 * tile.bold > tile.beyond_noise &&
         tile.kept.left > kUnlikeLeft && tile.left_share > kUnlikeLeft;
}

/// The same, if hints are all equal: a digit may share much with another.
bool is_odd(const TileEvidence& tile) {
  const int bold_part = tile.fit.energy > kOddEnergy * tile.beyond_noise ? 4 : 2;
  return tile.beyond_noise >= kOddPixels && bold_part * tile.bold > tile.beyond_noise &&
         tile.kept.left > kOddLeft && tile.left_share > kOddLeftShare &&
         std::ranges::max(tile.copied) < kOddCopied * tile.beyond_noise;
}

/// Labels of axes lie outermost to the left and below, titles and legends at other sides, and other
/// hints touch them all.
bool may_be_hints(const TileBounds& differing, const TileBounds& texture) {
  const bool left = differing.left - 1 <= texture.left, top = differing.top - 1 <= texture.top;
  const bool right = differing.right + 1 >= texture.right;
  const bool bottom = differing.bottom + 1 >= texture.bottom;
  return left + top + right + bottom >= 3 || (left && bottom);
}

struct ShapeCounts {
  double allowed_px;
  TileBounds differing;
  int tiles = 0, in_shape = 0, in_place = 0, unlike = 0, odd = 0, very_far = 0, far = 0;
  int right = 0, left = 0, down = 0, up = 0;  ///< Tiles that moved so.

  void add(const TileEvidence& tile, int x, int y) {
    if (tile.beyond_noise >= kFewShapePixels) differing.add(x, y);
    if (tile.beyond_noise < kShapePixels) return;
    ++tiles;
    const bool is_copy = tile.kept.left < kCopiedLeft;
    in_place += is_in_place(tile, allowed_px);
    in_shape += is_in_place(tile, allowed_px) || is_copy;
    unlike += is_unlike(tile);
    odd += is_odd(tile);
    very_far += is_moved(tile, allowed_px + kVeryFar);
    far += is_moved(tile, allowed_px + kFar) && !is_copy;
    if (!is_off(tile, allowed_px)) return;
    const double still = allowed_px + kStill;
    right += tile.kept.right_px > still, left += tile.kept.right_px < -still;
    down += tile.kept.down_px > still, up += tile.kept.down_px < -still;
  }

  /// What is put on whole pixels goes one way, whichever it is.
  bool is_astray() const {
    return std::max(std::min(right, left), std::min(down, up)) > kAstrayShare * tiles;
  }
};

}  // namespace

std::vector<bool> shape_changes(std::span<const int> tiles, std::span<const TileEvidence> evidence,
                                const Texture& texture, int across, double allowed_px) {
  ShapeCounts all{.allowed_px = allowed_px, .differing = {}};
  for (std::size_t i = 0; i < tiles.size(); ++i)
    all.add(evidence[i], tiles[i] % across, tiles[i] / across);
  const bool no_hints = !may_be_hints(all.differing, texture.bounds);
  const double most_unlike = kMostUnlikeShare * all.tiles;
  const bool any_moved = all.very_far > kVeryFarShare * all.tiles ||
                         (no_hints && all.far >= kFewestFar && all.far > kFarShare * all.tiles);
  const bool any_astray = no_hints && all.is_astray();
  const bool any_unlike = all.in_shape > kInShapeShare * all.tiles && all.unlike <= most_unlike;
  const bool any_odd =
      no_hints && all.in_place > kInPlaceShare * all.tiles && all.odd <= most_unlike;
  std::vector<bool> is_changed(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const TileEvidence& tile = evidence[i];
    is_changed[i] = (any_moved && is_moved(tile, allowed_px + kMoved)) ||
                    (any_astray && is_off(tile, allowed_px)) || (any_unlike && is_unlike(tile)) ||
                    (any_odd && is_odd(tile));
  }
  return is_changed;
}

}  // namespace mapproof
