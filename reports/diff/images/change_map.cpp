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

/// The tiles that touch a tile, corners too, and the tile itself, row by row.
std::vector<int> tiles_around(int tile, int across, int down) {
  const int x = tile % across, y = tile / across;
  std::vector<int> around;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, down - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, across - 1); ++u)
      around.push_back(v * across + u);
  return around;
}

}  // namespace

std::vector<std::vector<int>> tile_groups(int across, std::vector<bool> is_in) {
  std::vector<std::vector<int>> groups;
  const int down = across > 0 ? static_cast<int>(is_in.size()) / across : 0;
  for (int start = 0; start < static_cast<int>(is_in.size()); ++start) {
    if (!is_in[start]) continue;
    std::vector<int>& group = groups.emplace_back(1, start);
    is_in[start] = false;
    for (std::size_t next = 0; next < group.size(); ++next)
      for (const int tile : tiles_around(group[next], across, down))
        if (is_in[tile]) {
          is_in[tile] = false;
          group.push_back(tile);
        }
    std::ranges::sort(group);
  }
  return groups;
}

ChangedClusters::ChangedClusters(const ImageSize& size)
    : across_((size.width + kTile - 1) / kTile), down_((size.height + kTile - 1) / kTile) {}

void ChangedClusters::add(const ChangeMap& marks, int from, int to, int at) {
  for (int part = from * across_; part < to * across_; ++part) {
    const TileMarks* const tile_marks = marks.tile(part);
    if (!tile_marks) continue;
    const int x0 = part % across_ * kTile, y0 = (part / across_ + at) * kTile;
    Tile tile{.index = part + at * across_,
              .left = x0 + kTile,
              .top = y0 + kTile,
              .right = x0,
              .bottom = y0};
    for (int cell = 0; cell < kTile * kTile; ++cell) {
      if ((*tile_marks)[cell] != PixelMark::kChanged) continue;
      const int x = x0 + cell % kTile, y = y0 + cell / kTile;
      tile.left = std::min(tile.left, x), tile.right = std::max(tile.right, x + 1);
      tile.top = std::min(tile.top, y), tile.bottom = std::max(tile.bottom, y + 1);
      ++tile.pixels;
    }
    if (tile.pixels > 0) tiles_.push_back(tile);
  }
}

void ChangedClusters::sum_up(PixelDiff& pixels) const {
  std::vector<bool> is_changed(static_cast<std::size_t>(across_) * down_, false);
  for (const Tile& tile : tiles_) is_changed[tile.index] = true;
  for (const std::vector<int>& group : tile_groups(across_, is_changed)) {
    ++pixels.clusters;
    Tile all = *std::ranges::lower_bound(tiles_, group.front(), {}, &Tile::index);
    all.pixels = 0;
    for (const int index : group) {
      const Tile& tile = *std::ranges::lower_bound(tiles_, index, {}, &Tile::index);
      all.pixels += tile.pixels;
      all.left = std::min(all.left, tile.left), all.right = std::max(all.right, tile.right);
      all.top = std::min(all.top, tile.top), all.bottom = std::max(all.bottom, tile.bottom);
    }
    if (all.pixels <= pixels.largest_cluster_pixels) continue;
    pixels.largest_cluster_pixels = all.pixels;
    pixels.largest_cluster = {all.left, all.top, all.right - all.left, all.bottom - all.top};
  }
}

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
