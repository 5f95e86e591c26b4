#include "reports/diff/images/change_map.hpp"

#include <algorithm>
#include <utility>

namespace mapproof {
namespace {

/// Luma [BT.601] of a pixel, at a quarter of its distance from white.
std::uint32_t pale(std::uint32_t pixel) {
  const std::uint32_t luma =
      (77 * ((pixel >> 16) & 0xFF) + 150 * ((pixel >> 8) & 0xFF) + 29 * (pixel & 0xFF)) >> 8;
  return (192 + luma / 4) * 0x010101u;
}

}  // namespace

Image heat_map(Image baseline, const ChangeMap& marks) {
  Image map = std::move(baseline);
  std::ranges::transform(map.pixels, map.pixels.begin(), pale);
  for (int index = 0; index < marks.across() * marks.down(); ++index) {
    const TileMarks* tile = marks.tile(index);
    if (!tile) continue;
    const int x0 = index % marks.across() * kTile, y0 = index / marks.across() * kTile;
    for (int y = y0; y < std::min(y0 + kTile, map.height); ++y)
      for (int x = x0; x < std::min(x0 + kTile, map.width); ++x) {
        const PixelMark mark = (*tile)[(y - y0) * kTile + x - x0];
        if (mark == PixelMark::kChanged) map.row(y)[x] = kChangedColour;
        if (mark == PixelMark::kNoise || mark == PixelMark::kSmoothed) map.row(y)[x] = kNoiseColour;
      }
  }
  return map;
}

}  // namespace mapproof
