#include "reports/diff/images/changed_clusters.hpp"

#include <algorithm>

#include "reports/diff/images/pixel_judgement.hpp"

namespace mapproof {

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

}  // namespace mapproof
