#include "reports/diff/images/pixel_judgement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/base/not_finite.hpp"
#include "reports/diff/images/filter_fit.hpp"

namespace mapproof {
namespace {

// Tuned on the mutations of tests/reports/diff and on images by matplotlib with three kinds of
// hinting.
constexpr int kFewShapePixels = 4;    // Too few to determine a tile;
constexpr int kShapePixels = 8;       // too few to determine its shape.
constexpr double kKeptLeft = 0.1;     // Of the difference, what remains after a movement.
constexpr double kMoved = 0.45;       // Pixels beyond the allowed movement.
constexpr double kCopiedLeft = 0.01;  // Almost zero: shapes on whole pixels were so before.
constexpr double kStill = 0.15;       // The same: in place,
constexpr double kStillLeft = 0.2;    // with this share of the difference remaining.

// Bounds where hinting may be the cause.
constexpr double kVeryFar = 1.35;       // Pixels beyond the allowed movement. Hinting moves
constexpr double kVeryFarShare = 0.33;  // at most a quarter of all tiles so far.
constexpr double kInShapeShare = 0.7;   // Hinting reaches .66.
constexpr int kUnlikePixels = 16;
constexpr double kUnlikeLeft = 0.85;

// Bounds where hinting is not the cause but anti-aliasing, which keeps shapes in place.
constexpr double kFar = 0.7;        // Pixels beyond the allowed movement, not whole ones.
constexpr double kFarShare = 0.02;  // Anti-aliasing reaches .004,
constexpr int kFewestFar = 3;
constexpr double kAstray = 0.35;  // Pixels beyond, also for a marker on a line that stays:
constexpr double kAstrayLeft = 0.3;
constexpr double kAstrayShare = 0.1;    // of the tiles moved in each of two opposite directions.
constexpr double kInPlaceShare = 0.45;  // Where anti-aliasing changes shapes: .42.
constexpr int kOddPixels = 12;
constexpr double kOddLeft = 0.55;
constexpr double kOddLeftShare = 0.8;
constexpr double kOddEnergy = 1000.0;  // Squares of 1 of 255 per pixel beyond noise.
constexpr double kFaintShare = 0.9;    // Of tiles with less than that.
// A movement of .3 px has 3500, shapes without anti-aliasing 6000 to 12,000, another digit 22,000.
constexpr double kStarkEnergy = 6000.0;
constexpr double kDigitEnergy = 12000.0;
constexpr int kMostStark = 2;        // Text without anti-aliasing has more such tiles.
constexpr double kOddCopied = 0.35;  // Of the pixels beyond noise; more moved by one pixel.

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

/// Whether the tile shows a different shape, and not the same one with different hinting.
bool is_unlike(const TileEvidence& tile) {
  return tile.beyond_noise >= kUnlikePixels && 2 * tile.bold > tile.beyond_noise &&
         tile.kept.left > kUnlikeLeft && tile.left_share > kUnlikeLeft;
}

/// The same where hinting is equal: a digit may have much in common with another.
bool is_odd(const TileEvidence& tile) {
  const int bold_part = tile.fit.energy > kOddEnergy * tile.beyond_noise ? 4 : 2;
  return tile.beyond_noise >= kOddPixels && bold_part * tile.bold > tile.beyond_noise &&
         tile.kept.left > kOddLeft && tile.left_share > kOddLeftShare &&
         std::ranges::max(tile.copied) < kOddCopied * tile.beyond_noise;
}

bool has_energy(const TileEvidence& tile, double of_pixel) {
  return tile.fit.energy > of_pixel * tile.beyond_noise;
}

/// Axis labels are outermost to the left and below, titles and legends at other sides; different
/// hinting affects them all.
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
  int faint = 0, stark = 0;                   ///< Tiles that differ little, and much.
  int right = 0, left = 0, down = 0, up = 0;  ///< Tiles that moved in this direction.

  void add(const TileEvidence& tile, int x, int y) {
    if (tile.beyond_noise >= kFewShapePixels) differing.add(x, y);
    if (tile.beyond_noise < kShapePixels) return;
    ++tiles;
    const bool is_copy = tile.kept.left < kCopiedLeft;
    in_place += is_in_place(tile, allowed_px);
    in_shape += is_in_place(tile, allowed_px) || is_copy;
    unlike += is_unlike(tile);
    odd += is_odd(tile);
    faint += !has_energy(tile, kOddEnergy);
    stark += has_energy(tile, kStarkEnergy);
    very_far += is_moved(tile, allowed_px + kVeryFar);
    far += is_moved(tile, allowed_px + kFar) && !is_copy;
    if (!is_off(tile, allowed_px)) return;
    const double still = allowed_px + kStill;
    right += tile.kept.right_px > still, left += tile.kept.right_px < -still;
    down += tile.kept.down_px > still, up += tile.kept.down_px < -still;
  }

  /// Shapes that are aligned to whole pixels move in one direction, whichever it is.
  bool is_astray() const {
    return std::max(std::min(right, left), std::min(down, up)) > kAstrayShare * tiles;
  }
};

// Tuned on the mutations of tests/reports/diff, which are on both sides of each bound, some a third
// away; but for kMovedShare .58 must pass and .64 must fail.
constexpr int kMostLocalGroups = 3;
constexpr double kMostLocalShare = 0.12;  // Of the tiles with anything in them.
constexpr int kMostSparseGroups = 6;      // This also counts as few regions,
constexpr double kSparseShare = 0.02;     // if they are this small.
constexpr double kLeftShare = 0.3;        // Of a group's difference, beyond a small movement.
constexpr double kLostShare = 0.1;        // Of the pixels beyond noise.
constexpr double kMovedShare = 0.61;      // Of the difference, in one direction.
constexpr double kCopiedShare =
    0.6;  // Of the clear pixels: half without anti-aliasing, .7 with layers.
constexpr double kClearShare = 0.25;      // Of the pixels beyond noise; of noise, one in a hundred.
constexpr double kMovedTouched = 0.63;    // Of the tiles with anything in them.
constexpr double kFarMoved = 1.6;         // Pixels; hinting moves letters by less.
constexpr double kRecolouredShare = 0.2;  // Of the difference.
constexpr double kOneSidedShare = 0.6;    // Of the difference and of tiles.
constexpr double kBoldShare = 0.1;        // Of the pixels beyond noise.
constexpr double kLeftSquare = 0.14;      // Of the squares of slopes: .37 px unexplained.
constexpr double kInStepShare = 0.75;     // Of tiles that differ,
constexpr double kTouchedShare = 0.4;     // which must be this share of the tiles with content;
constexpr double kMostOutShare = 0.2;     // of the tiles that do not.
constexpr std::size_t kMostOutOfStep = 12;
constexpr int kFewPixels = 4;  // Too few to determine a tile.
// Of the difference, by a symmetric filter. Blur, sharpening and resampling to half reach .9 to 1
// in plots by six programs; drawing without anti-aliasing reaches .73, other hinting .45.
constexpr double kFilteredShare = 0.85;
constexpr double kFilterWidth = 0.15;  // Pixels beyond the allowed movement.

bool is_moved(const TileEvidence& tile, const ImageOptions& options) {
  // Anti-aliasing aligns a line to whole pixels, up to half a pixel away.
  return tile.moved_share > 0.7 && tile.displacement_px() > options.displacement_px + 0.45 &&
         tile.displacement_px() < 3.0 && tile.left_by_whole < 0.3;
}

bool is_recoloured(const TileEvidence& tile) {
  return tile.recoloured_share > 0.95 && tile.recolouring > 2.5 && tile.edge_pixels >= 24;
}

/// Whether blur or sharpening explains the difference, by a Gaussian of half a pixel and more.
bool is_filtered(const FilterFit& fit, const ImageOptions& options) {
  const FilterFit::Filter filter = fit.filter();
  const double least_px = options.displacement_px + kFilterWidth;
  return filter.explained > kFilteredShare && std::abs(filter.variance_px2) > least_px * least_px;
}

/// Sets marks of the tile to kChanged where `from` is true.
template <typename From>
void change(TileMarks& marks, From from) {
  for (PixelMark& mark : marks)
    if (from(mark)) mark = PixelMark::kChanged;
}

void change_edges(TileMarks& marks) {
  change(marks, [](PixelMark mark) { return mark == PixelMark::kSmoothed; });
}

/// The evidence of a group of tiles.
struct GroupEvidence {
  double energy = 0.0, left = 0.0, recoloured = 0.0;
  int beyond_noise = 0, bold = 0;
  std::array<double, 3> sum{}, absolute_sum{};
  FilterFit filter;

  void add(const TileEvidence& tile) {
    filter.add(tile.filter);
    energy += tile.fit.energy;
    left += tile.fit.energy * tile.left_share;
    beyond_noise += tile.beyond_noise;
    bold += tile.bold;
    if (tile.recolouring > 2.5) recoloured += tile.fit.energy * tile.recoloured_share;
    for (int c = 0; c < 3; ++c) sum[c] += tile.sum[c], absolute_sum[c] += tile.absolute_sum[c];
  }

  /// Whether a channel changes in one direction nearly everywhere, which a movement does not cause.
  bool is_one_sided() const {
    for (int c = 0; c < 3; ++c)
      if (beyond_noise >= 64 && std::abs(sum[c]) > 0.9 * absolute_sum[c] &&
          absolute_sum[c] >= beyond_noise)
        return true;
    return false;
  }

  /// Whether little of the difference remains after a small movement, or only edges became slightly
  /// stronger or weaker where one shape is partly under another.
  bool is_a_small_movement() const {
    return left <= kLeftShare * energy ||
           (bold <= kBoldShare * beyond_noise && recoloured <= 0.4 * energy && !is_one_sided());
  }
};

/// Judges differences in few regions.
void judge_locally(const std::vector<std::vector<int>>& groups,
                   const std::vector<const TileEvidence*>& of_tile, const ImageOptions& options,
                   ChangeMap& marks) {
  for (const std::vector<int>& group : groups) {
    GroupEvidence shown;
    for (const int tile : group) shown.add(*of_tile[tile]);
    if (shown.is_a_small_movement() && !is_filtered(shown.filter, options)) continue;
    for (const int tile : group) change_edges(*marks.tile(tile));
  }
}

/// Judges differences everywhere.
struct OverallEvidence {
  double energy = 0.0, recoloured = 0.0, beyond = 0.0, clear = 0.0, lost = 0.0;
  double sided = 0.0,
         one_sided = 0.0;          ///< Energies of tiles that can be so, and of those that are.
  double right = 0.0, down = 0.0;  ///< Sums of the directions of movements, weighted by energy.
  double far_right = 0.0, far_down = 0.0;  ///< The same for large movements.
  std::array<double, 8> copied{};
  FilterFit filter;
  int tiles = 0, one_sided_tiles = 0;

  void add(const TileEvidence& tile, const ImageOptions& options) {
    energy += tile.fit.energy;
    if (is_moved(tile, options)) add_movement(tile);
    if (is_recoloured(tile)) recoloured += tile.fit.energy;
    beyond += tile.beyond_noise;
    clear += tile.clear;
    filter.add(tile.filter);
    lost += tile.lost;
    for (std::size_t step = 0; step < copied.size(); ++step) copied[step] += tile.copied[step];
    if (tile.beyond_noise < kFewPixels) return;
    ++tiles;  // Noise on white paper is always darker.
    if (tile.sided < kFewPixels) return;
    sided += tile.fit.energy;
    if (!tile.is_one_sided()) return;
    ++one_sided_tiles;
    one_sided += tile.fit.energy;
  }
  void add_movement(const TileEvidence& tile) {
    const double x = tile.fit.energy * tile.right_px / tile.displacement_px();
    const double y = tile.fit.energy * tile.down_px / tile.displacement_px();
    right += x, down += y;
    if (tile.displacement_px() > kFarMoved) far_right += x, far_down += y;
  }
  bool any_lost() const { return lost > kLostShare * beyond; }
  /// The origin of the pixels, as one of kNeighbourSteps, if most are copies of a neighbour.
  std::optional<std::size_t> copied_from() const {
    const auto most = std::ranges::max_element(copied);
    if (*most <= kCopiedShare * clear || clear < kClearShare * beyond) return std::nullopt;
    return most - copied.begin();
  }
  /// Different hinting also moves letters, all in one direction, but not far, and other shapes
  /// stay.
  bool any_moved(int textured) const {
    return std::hypot(far_right, far_down) > kMovedShare * energy ||
           (std::hypot(right, down) > kMovedShare * energy && tiles > kMovedTouched * textured);
  }
  bool any_recoloured() const { return recoloured > kRecolouredShare * energy; }
  /// Whether a line became thicker or a pale grid was lost: anti-aliasing keeps the sum.
  bool is_one_sided() const {
    return one_sided > kOneSidedShare * sided && one_sided_tiles > kOneSidedShare * tiles;
  }
};

void judge_overall(std::span<const int> tiles, std::span<const TileEvidence> evidence, int textured,
                   const ImageOptions& options, ChangeMap& marks) {
  OverallEvidence all;
  for (const TileEvidence& tile : evidence) all.add(tile, options);
  const std::optional<std::size_t> step = all.copied_from();
  const bool any_filtered = is_filtered(all.filter, options);
  for (std::size_t i = 0; i < tiles.size(); ++i)
    if (any_filtered || (all.any_lost() && evidence[i].lost > 0) ||
        (step && 2 * evidence[i].copied[*step] > evidence[i].beyond_noise) ||
        (all.any_moved(textured) && is_moved(evidence[i], options)) ||
        (all.any_recoloured() && is_recoloured(evidence[i])) ||
        (all.is_one_sided() && evidence[i].is_one_sided()))
      change_edges(*marks.tile(tiles[i]));
}

/// The common movement, by iteratively reweighted least squares over tiles: tiles that it does not
/// explain get less weight.
std::array<double, 2> common_movement(std::span<const TileEvidence> evidence) {
  std::array<double, 2> movement{};
  for (int round = 0; round < 8; ++round) {
    MovementFit all;
    for (const TileEvidence& tile : evidence) {
      if (tile.fit.energy == 0.0) continue;
      const double left = round == 0 ? 0.0 : tile.fit.left(movement[0], movement[1]);
      const double share = left / (kLeftShare * tile.fit.energy);
      // Every tile has the same weight, whatever its contrast: one lost shape would outweigh a
      // small shift of all.
      all.add(tile.fit, 1.0 / (tile.fit.energy * (1.0 + share * share)));
    }
    movement = all.movement();
  }
  return movement;
}

/// The tiles that a small common movement does not explain, if there are few; none if there are
/// many, or no such movement.
std::vector<bool> out_of_step(std::span<const int> tiles, std::span<const TileEvidence> evidence,
                              int textured, const ImageOptions& options, const ChangeMap& marks) {
  const auto [right, down] = common_movement(evidence);
  std::vector<bool> is_out(static_cast<std::size_t>(marks.across()) * marks.down(), false);
  int out = 0, all = 0, explained = 0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const TileEvidence& tile = evidence[i];
    if (tile.beyond_noise < kFewPixels) continue;
    ++all;
    const double left = tile.fit.left(right, down), slopes = tile.fit.gxx + tile.fit.gyy;
    explained += left < 0.5 * tile.fit.energy;
    is_out[tiles[i]] = left > kLeftShare * tile.fit.energy && left > kLeftSquare * slopes;
    out += is_out[tiles[i]];
  }
  const bool is_in_step = std::hypot(right, down) <= options.displacement_px &&
                          explained > kInStepShare * all && all > kTouchedShare * textured;
  if (!is_in_step || out > kMostOutShare * all ||
      tile_groups(marks.across(), is_out).size() > kMostOutOfStep)
    is_out.assign(is_out.size(), false);
  return is_out;
}

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
  // Where all shapes moved a little, few tiles differ much.
  const double odd_energy = no_hints && all.faint > kFaintShare * all.tiles ? kOddEnergy
                            : all.stark <= kMostStark                       ? kDigitEnergy
                                                                            : kInfinity;
  std::vector<bool> is_changed(tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const TileEvidence& tile = evidence[i];
    is_changed[i] = (any_moved && is_moved(tile, allowed_px + kMoved)) ||
                    (any_astray && is_off(tile, allowed_px)) || (any_unlike && is_unlike(tile)) ||
                    (is_odd(tile) && (any_odd || has_energy(tile, odd_energy)));
  }
  return is_changed;
}

void judge(std::span<const int> tiles, std::span<const TileEvidence> evidence,
           const Texture& texture, const ImageOptions& options, ChangeMap& marks) {
  const std::size_t count = static_cast<std::size_t>(marks.across()) * marks.down();
  std::vector<bool> is_beyond(count, false);
  std::vector<const TileEvidence*> of_tile(count, nullptr);
  int beyond = 0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    of_tile[tiles[i]] = &evidence[i];
    is_beyond[tiles[i]] = evidence[i].beyond_noise > 0;
    beyond += evidence[i].beyond_noise > 0;
  }
  const int textured = texture.tiles;
  const auto groups = tile_groups(marks.across(), is_beyond);
  const int locations = static_cast<int>(groups.size());
  const bool is_local =
      (locations <= kMostLocalGroups && beyond <= std::max(1.0, kMostLocalShare * textured)) ||
      (locations <= kMostSparseGroups && beyond <= kSparseShare * textured);
  for (std::size_t i = 0; i < tiles.size(); ++i)
    if ((is_local ? evidence[i].flat_shift : evidence[i].flat_shift_in_noise) > 0.0)
      change(*marks.tile(tiles[i]), [](PixelMark mark) { return mark != PixelMark::kEqual; });
  if (is_local)
    judge_locally(groups, of_tile, options, marks);
  else {
    judge_overall(tiles, evidence, textured, options, marks);
    const std::vector<bool> is_out = out_of_step(tiles, evidence, textured, options, marks);
    const std::vector<bool> is_changed =
        shape_changes(tiles, evidence, texture, marks.across(), options.displacement_px);
    for (std::size_t i = 0; i < tiles.size(); ++i)
      if (is_out[tiles[i]] || is_changed[i]) change_edges(*marks.tile(tiles[i]));
  }
}

}  // namespace mapproof
