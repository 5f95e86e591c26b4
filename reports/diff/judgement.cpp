#include "reports/diff/judgement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mapproof {
namespace {

// Found on the mutations of tests/reports/diff, which lie on both sides of each: some a third away,
// but of kMovedShare .58 must pass and .64 must fail.
constexpr int kMostLocalGroups = 3;
constexpr double kMostLocalShare = 0.12;  // Of the tiles with anything in them.
constexpr double kLeftShare = 0.3;        // Of a group's difference, beyond a small movement.
constexpr double kLostShare = 0.1;        // Of the pixels beyond noise.
constexpr double kMovedShare = 0.61;      // Of the difference, one way.
constexpr double kRecolouredShare = 0.2;  // Of the difference.

bool is_moved(const TileEvidence& tile, const PictureOptions& options) {
  // Smoothing puts a line on whole pixels, up to half of one away.
  return tile.moved_share > 0.7 && tile.displacement_px() > options.displacement_px + 0.45 &&
         tile.displacement_px() < 3.0;
}

bool is_recoloured(const TileEvidence& tile) {
  return tile.recoloured_share > 0.95 && tile.recolouring > 2.5 && tile.edge_pixels >= 24;
}

/// Turns marks of the tile into kChanged where `from` says so.
template <typename From>
void change(TileMarks& marks, From from) {
  for (PixelMark& mark : marks)
    if (from(mark)) mark = PixelMark::kChanged;
}

void change_edges(TileMarks& marks) {
  change(marks, [](PixelMark mark) { return mark == PixelMark::kSmoothed; });
}

/// All that a group of tiles shows.
struct GroupEvidence {
  double energy = 0.0, left = 0.0, recoloured = 0.0;
  int beyond_noise = 0, bold = 0;
  std::array<double, 3> sum{}, absolute_sum{};

  void add(const TileEvidence& tile) {
    energy += tile.energy;
    left += tile.energy * tile.left_share;
    beyond_noise += tile.beyond_noise;
    bold += tile.bold;
    if (tile.recolouring > 2.5) recoloured += tile.energy * tile.recoloured_share;
    for (int c = 0; c < 3; ++c) sum[c] += tile.sum[c], absolute_sum[c] += tile.absolute_sum[c];
  }

  /// Whether some channel goes one way nearly everywhere, which a movement does not do.
  bool is_one_sided() const {
    for (int c = 0; c < 3; ++c)
      if (beyond_noise >= 64 && std::abs(sum[c]) > 0.9 * absolute_sum[c] &&
          absolute_sum[c] >= beyond_noise)
        return true;
    return false;
  }

  /// What is left of the difference without a small movement is little, or it is but edges that
  /// become a bit stronger or weaker where one thing peeps out from under another.
  bool is_a_small_movement() const {
    return left <= kLeftShare * energy ||
           (bold <= 0.1 * beyond_noise && recoloured <= 0.4 * energy && !is_one_sided());
  }
};

/// What differs in few places.
void judge_locally(const std::vector<std::vector<int>>& groups,
                   const std::vector<const TileEvidence*>& of_tile, ChangeMap& marks) {
  for (const std::vector<int>& group : groups) {
    GroupEvidence shown;
    for (const int tile : group) shown.add(*of_tile[tile]);
    if (shown.is_a_small_movement()) continue;
    for (const int tile : group) change_edges(*marks.tile(tile));
  }
}

/// What differs all over.
void judge_overall(std::span<const int> tiles, std::span<const TileEvidence> evidence,
                   const PictureOptions& options, ChangeMap& marks) {
  double energy = 0.0, right = 0.0, down = 0.0, recoloured = 0.0, beyond = 0.0, lost = 0.0;
  for (const TileEvidence& tile : evidence) {
    energy += tile.energy;
    if (is_moved(tile, options)) {
      right += tile.energy * tile.right_px / tile.displacement_px();
      down += tile.energy * tile.down_px / tile.displacement_px();
    }
    if (is_recoloured(tile)) recoloured += tile.energy;
    beyond += tile.beyond_noise;
    lost += tile.lost;
  }
  const bool any_lost = lost > kLostShare * beyond;
  // Other hints move letters apart; what is moved goes one way.
  const bool any_moved = std::hypot(right, down) > kMovedShare * energy;
  const bool any_recoloured = recoloured > kRecolouredShare * energy;
  for (std::size_t i = 0; i < tiles.size(); ++i)
    if ((any_lost && evidence[i].lost > 0) || (any_moved && is_moved(evidence[i], options)) ||
        (any_recoloured && is_recoloured(evidence[i])))
      change_edges(*marks.tile(tiles[i]));
}

}  // namespace

std::vector<std::vector<int>> tile_groups(int across, std::vector<bool> is_in) {
  std::vector<std::vector<int>> groups;
  const int down = across > 0 ? static_cast<int>(is_in.size()) / across : 0;
  for (int start = 0; start < static_cast<int>(is_in.size()); ++start) {
    if (!is_in[start]) continue;
    std::vector<int>& group = groups.emplace_back(1, start);
    is_in[start] = false;
    for (std::size_t next = 0; next < group.size(); ++next) {
      const int x = group[next] % across, y = group[next] / across;
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, down - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, across - 1); ++u)
          if (const int tile = v * across + u; is_in[tile]) {
            is_in[tile] = false;
            group.push_back(tile);
          }
    }
    std::ranges::sort(group);
  }
  return groups;
}

void judge(std::span<const int> tiles, std::span<const TileEvidence> evidence, int textured,
           const PictureOptions& options, ChangeMap& marks) {
  const std::size_t count = static_cast<std::size_t>(marks.across()) * marks.down();
  std::vector<bool> is_beyond(count, false);
  std::vector<const TileEvidence*> of_tile(count, nullptr);
  int beyond = 0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    of_tile[tiles[i]] = &evidence[i];
    is_beyond[tiles[i]] = evidence[i].beyond_noise > 0;
    beyond += evidence[i].beyond_noise > 0;
  }
  const auto groups = tile_groups(marks.across(), is_beyond);
  const bool is_local = static_cast<int>(groups.size()) <= kMostLocalGroups &&
                        beyond <= std::max(1.0, kMostLocalShare * textured);
  for (std::size_t i = 0; i < tiles.size(); ++i)
    if ((is_local ? evidence[i].flat_shift : evidence[i].flat_shift_in_noise) > 0.0)
      change(*marks.tile(tiles[i]), [](PixelMark mark) { return mark != PixelMark::kEqual; });
  if (is_local)
    judge_locally(groups, of_tile, marks);
  else
    judge_overall(tiles, evidence, options, marks);
}

}  // namespace mapproof
