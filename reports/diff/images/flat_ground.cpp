#include "reports/diff/images/flat_ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "core/base/parallel.hpp"

namespace mapproof {
namespace {

// Measured on harmless pairs of images by six programs (tests/bench/diff_foreign.py): hinting and
// anti-aliasing draw nothing further away from what was drawn.
constexpr int kRenderingStep_px = 2;
constexpr int kFlat = 6;  // Of 255. Noise of a standard deviation of 1 stays within it.

constexpr int kLeastContrast = 10, kLeastStrongContrast = 21;  // Of 255: 12 and 24, less noise.
constexpr int kFewestWeak = 20, kFewestStrong = 4;

/// How far a pixel is from its ground. A pixel that was taken into a group has none.
enum class Contrast : std::uint8_t { kNone, kWeak, kStrong };

using TileContrasts = std::array<Contrast, kTile * kTile>;

struct PixelAt {
  int x, y;
};

int channel(std::uint32_t pixel, int c) { return static_cast<int>((pixel >> (8 * c)) & 0xFF); }

PixelBox around(const PixelBox& box, int reach) {
  return {box.x - reach, box.y - reach, box.width + 2 * reach, box.height + 2 * reach};
}

/// @param box  Cut off at the image's edges.
bool is_flat_in(const Image& image, const PixelBox& box) {
  std::array<int, 3> low{255, 255, 255}, high{};
  for (int y = std::max(box.y, 0); y < std::min(box.y + box.height, image.height); ++y)
    for (int x = std::max(box.x, 0); x < std::min(box.x + box.width, image.width); ++x)
      for (int c = 0; c < 3; ++c) {
        const int value = channel(image.row(y)[x], c);
        low[c] = std::min(low[c], value), high[c] = std::max(high[c], value);
        if (high[c] - low[c] > kFlat) return false;
      }
  return true;
}

/// The pixels at which one image differs from the flat ground of the other.
class PixelsOnGround {
 public:
  PixelsOnGround(const Image& ground, const Image& drawn, const std::vector<int>& tiles,
                 const ImageOptions& options, ChangeMap& marks)
      : ground_(ground),
        drawn_(drawn),
        tiles_(tiles),
        weak_(std::max<double>(kLeastContrast, options.noise + 1.0)),
        strong_(std::max<double>(kLeastStrongContrast, options.noise + 1.0)),
        reach_(kRenderingStep_px +
               static_cast<int>(std::ceil(
                   std::max(0.0, options.displacement_px - ImageTolerances::kDisplacement_px)))),
        marks_(marks),
        index_(static_cast<std::size_t>(marks.across()) * marks.down(), -1),
        contrasts_(tiles.size()) {
    for (std::size_t i = 0; i < tiles.size(); ++i) index_[tiles[i]] = static_cast<int>(i);
    parallel_for(tiles.size(), [this](std::size_t i) { find_in(i); });
  }

  /// Marks the groups that are large enough. @return Whether there is one.
  bool mark() {
    bool any = false;
    for (std::size_t i = 0; i < tiles_.size(); ++i)
      for (int cell = 0; cell < kTile * kTile; ++cell)
        if (contrasts_[i][cell] != Contrast::kNone) any = mark_group(pixel_at(i, cell)) || any;
    return any;
  }

 private:
  PixelAt pixel_at(std::size_t i, int cell) const {
    return {tiles_[i] % marks_.across() * kTile + cell % kTile,
            tiles_[i] / marks_.across() * kTile + cell / kTile};
  }
  void find_in(std::size_t i);
  Contrast take(PixelAt at);
  bool mark_group(PixelAt first);

  const Image& ground_;
  const Image& drawn_;
  const std::vector<int>& tiles_;
  double weak_, strong_;
  int reach_;
  ChangeMap& marks_;
  std::vector<int> index_;  ///< Of each tile of the image in tiles_; -1 where both are equal.
  std::vector<TileContrasts> contrasts_;
};

void PixelsOnGround::find_in(std::size_t i) {
  const TileMarks& marks = *marks_.tile(tiles_[i]);
  const PixelAt corner = pixel_at(i, 0);
  const bool is_flat_tile = is_flat_in(ground_, around({corner.x, corner.y, kTile, kTile}, reach_));
  for (int cell = 0; cell < kTile * kTile; ++cell) {
    if (marks[cell] == PixelMark::kEqual) continue;  // So are cells beyond the image's edge.
    const PixelAt at = pixel_at(i, cell);
    const int contrast = largest_difference(ground_.row(at.y)[at.x], drawn_.row(at.y)[at.x]);
    if (contrast < weak_ ||
        !(is_flat_tile || is_flat_in(ground_, around({at.x, at.y, 1, 1}, reach_))))
      continue;
    contrasts_[i][cell] = contrast < strong_ ? Contrast::kWeak : Contrast::kStrong;
  }
}

/// The contrast of a pixel, which then has none.
Contrast PixelsOnGround::take(PixelAt at) {
  if (at.x < 0 || at.y < 0 || at.x >= ground_.width || at.y >= ground_.height)
    return Contrast::kNone;
  const int i = index_[at.y / kTile * marks_.across() + at.x / kTile];
  if (i < 0) return Contrast::kNone;
  return std::exchange(contrasts_[i][at.y % kTile * kTile + at.x % kTile], Contrast::kNone);
}

bool PixelsOnGround::mark_group(PixelAt first) {
  std::vector<PixelAt> group{first};
  int strong = take(first) == Contrast::kStrong;
  for (std::size_t next = 0; next < group.size(); ++next)
    for (int cell = 0; cell < 9; ++cell) {
      const PixelAt at{group[next].x + cell % 3 - 1, group[next].y + cell / 3 - 1};
      const Contrast contrast = take(at);
      if (contrast == Contrast::kNone) continue;
      strong += contrast == Contrast::kStrong;
      group.push_back(at);
    }
  if (strong < kFewestStrong && static_cast<int>(group.size()) < kFewestWeak) return false;
  for (const PixelAt at : group)
    (*marks_.tile(at.y / kTile * marks_.across() +
                  at.x / kTile))[at.y % kTile * kTile + at.x % kTile] = PixelMark::kChanged;
  return true;
}

constexpr int kMostRounding = 4;  // Of 255: one entry of 256 in a steep colour table (jet).
constexpr std::size_t kFewestColours = 16;
constexpr double kLeastSteps = 0.3;   // Of the borders between cells: half and more if rounded.
constexpr double kMostWithin = 0.05;  // Of those, borders of the difference within cells.
constexpr double kMostMean = 1.0;  // Of 255, at these borders: floor against nearest gives a half.

/// How differences are spread over cells of one colour: where a cell ends, what differs changes,
/// and within it nothing does.
class RoundingEvidence {
 public:
  RoundingEvidence(const Image& baseline, const Image& current)
      : baseline_(baseline), current_(current) {}

  void add(int x, int y) {
    const std::uint32_t before = baseline_.row(y)[x], after = current_.row(y)[x];
    const bool right = x + 1 < baseline_.width, below = y + 1 < baseline_.height;
    if (right) add_border({x, y}, {x + 1, y});
    if (below) add_border({x, y}, {x, y + 1});
    if (!right || !below || !is_solid(baseline_, x, y) || !is_solid(current_, x, y)) return;
    if (before != after && colours_.size() < kFewestColours) colours_.insert(before);
  }

  bool is_rounding() const {
    const double most = std::max({std::abs(sum_[0]), std::abs(sum_[1]), std::abs(sum_[2])});
    return colours_.size() >= kFewestColours && steps_ > kLeastSteps * borders_ &&
           within_ <= kMostWithin * steps_ && most <= kMostMean * 2.0 * borders_;
  }

 private:
  static bool is_solid(const Image& image, int x, int y) {
    const std::uint32_t* row = image.row(y) + x;
    const std::uint32_t* below = image.row(y + 1) + x;
    return row[0] == row[1] && row[0] == below[0] && row[0] == below[1];
  }
  std::array<int, 3> difference(PixelAt at) const {
    const std::uint32_t before = baseline_.row(at.y)[at.x], after = current_.row(at.y)[at.x];
    return {channel(after, 0) - channel(before, 0), channel(after, 1) - channel(before, 1),
            channel(after, 2) - channel(before, 2)};
  }
  void add_border(PixelAt one, PixelAt other) {
    const std::array<int, 3> here = difference(one), there = difference(other);
    if (here == std::array<int, 3>{} && there == here) return;
    const bool is_border = baseline_.row(one.y)[one.x] != baseline_.row(other.y)[other.x];
    borders_ += is_border;
    if (is_border)
      for (int c = 0; c < 3; ++c) sum_[c] += here[c] + there[c];
    steps_ += is_border && here != there;
    within_ += !is_border && here != there;
  }

  const Image &baseline_, &current_;
  double borders_ = 0.0, steps_ = 0.0, within_ = 0.0;
  std::array<double, 3> sum_{};
  std::set<std::uint32_t> colours_;
};

bool is_within(const Image& baseline, const Image& current, const PixelBox& box, int most) {
  for (int y = box.y; y < box.y + box.height; ++y)
    for (int x = box.x; x < box.x + box.width; ++x)
      if (largest_difference(baseline.row(y)[x], current.row(y)[x]) > most) return false;
  return true;
}

}  // namespace

std::vector<bool> rounded_tiles(const Image& baseline, const Image& current,
                                const std::vector<int>& tiles, int across) {
  const auto box_of = [&](int tile) -> PixelBox {
    const int x0 = tile % across * kTile, y0 = tile / across * kTile;
    return {x0, y0, std::min(kTile, baseline.width - x0), std::min(kTile, baseline.height - y0)};
  };
  std::vector<bool> is_rounded(tiles.size(), false);
  RoundingEvidence evidence(baseline, current);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const PixelBox box = box_of(tiles[i]);
    is_rounded[i] = is_within(baseline, current, box, kMostRounding);
    for (int y = box.y; is_rounded[i] && y < box.y + box.height; ++y)
      for (int x = box.x; x < box.x + box.width; ++x) evidence.add(x, y);
  }
  if (!evidence.is_rounding()) is_rounded.assign(is_rounded.size(), false);
  return is_rounded;
}

bool mark_drawing_on_flat_ground(const Image& baseline, const Image& current,
                                 const std::vector<int>& tiles, const ImageOptions& options,
                                 ChangeMap& marks) {
  const bool any_new = PixelsOnGround(baseline, current, tiles, options, marks).mark();
  const bool any_lost = PixelsOnGround(current, baseline, tiles, options, marks).mark();
  return any_new || any_lost;
}

}  // namespace mapproof
