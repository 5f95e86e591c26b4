#include "reports/diff/images/pixel_diff.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/flat_ground.hpp"
#include "reports/diff/images/pixel_judgement.hpp"
#include "reports/diff/images/tile_evidence.hpp"

namespace mapproof {

namespace {

// An image has noise everywhere if this share of its pixels differ by no more than noise.
constexpr double kNoisyShare = 0.2;

// Of 255: a contrast above any allowed noise.
constexpr double kContrast = 16.0;

/// The result of the first pass over a tile.
struct TileStyle {
  bool differs = false;
  bool is_textured = false;   ///< Not of one colour.
  bool has_contrast = false;  ///< It has colours further apart than kContrast.
  int within_noise = 0;       ///< Pixels that differ by no more than noise.
};

/// The pixels of a tile, cut off at the image's edge.
PixelBox box_of(const ChangeMap& marks, const Image& image, int tile) {
  const int x0 = tile % marks.across() * kTile, y0 = tile / marks.across() * kTile;
  return {x0, y0, std::min(kTile, image.width - x0), std::min(kTile, image.height - y0)};
}

/// Makes `current` equal to the baseline in the boxes. @return The number of pixels in them.
std::int64_t ignore(const Image& baseline, Image& current, const std::vector<PixelBox>& boxes) {
  std::vector<bool> is_ignored(boxes.empty() ? 0 : baseline.pixels.size());
  for (const PixelBox& box : boxes) {
    const std::int64_t right =
        std::min<std::int64_t>(std::int64_t{box.x} + box.width, baseline.width);
    const std::int64_t end =
        std::min<std::int64_t>(std::int64_t{box.y} + box.height, baseline.height);
    for (std::int64_t y = std::max(box.y, 0); y < end; ++y)
      for (std::int64_t x = std::max(box.x, 0); x < right; ++x) {
        const std::size_t i = static_cast<std::size_t>(y * baseline.width + x);
        current.pixels[i] = baseline.pixels[i];
        is_ignored[i] = true;
      }
  }
  return std::ranges::count(is_ignored, true);
}

bool is_within(std::uint32_t a, std::uint32_t b, double noise) {
  return largest_difference(a, b) <= noise;
}

TileStyle look_at(const Image& a, const Image& b, const PixelBox& box, double noise) {
  TileStyle style;
  const std::uint32_t first = a.row(box.y)[box.x];
  for (int y = box.y; y < box.y + box.height; ++y) {
    const std::uint32_t *p = a.row(y) + box.x, *q = b.row(y) + box.x;
    style.is_textured =
        style.is_textured || std::any_of(p, p + box.width, [=](auto v) { return v != first; });
    style.has_contrast =
        style.has_contrast || (style.is_textured && std::any_of(p, p + box.width, [=](auto v) {
                                 return !is_within(v, first, kContrast);
                               }));
    if (std::memcmp(p, q, sizeof *p * static_cast<std::size_t>(box.width)) == 0) continue;
    style.differs = true;
    for (int x = 0; x < box.width; ++x)
      style.within_noise += p[x] != q[x] && is_within(p[x], q[x], noise);
  }
  return style;
}

std::vector<TileStyle> styles_at(const Image& baseline, const Image& current,
                                 const ChangeMap& marks, double noise) {
  std::vector<TileStyle> styles(static_cast<std::size_t>(marks.across()) * marks.down());
  parallel_for(static_cast<std::size_t>(marks.down()), [&](std::size_t i) {
    const int row = static_cast<int>(i);
    for (int tile = row * marks.across(); tile < (row + 1) * marks.across(); ++tile)
      styles[tile] = look_at(baseline, current, box_of(marks, baseline, tile), noise);
  });
  return styles;
}

/// Sums the evidence of all tiles.
void sum_up(std::span<const int> tiles, std::span<const TileEvidence> evidence,
            const ChangeMap& marks, PixelDiff& pixels) {
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const TileEvidence& tile = evidence[i];
    const TileMarks& tile_marks = *marks.tile(tiles[i]);
    const std::int64_t changed = std::ranges::count(tile_marks, PixelMark::kChanged);
    pixels.differing += tile.differing;
    pixels.changed += changed;
    pixels.antialiased += std::ranges::count(tile_marks, PixelMark::kSmoothed);
    pixels.largest_colour_difference =
        std::max(pixels.largest_colour_difference, tile.largest_colour_difference);
    pixels.largest_mean_shift = std::max(pixels.largest_mean_shift, tile.flat_shift);
    if (tile.moved_share > 0.7 && changed > 0)
      pixels.largest_displacement_px =
          std::max(pixels.largest_displacement_px, tile.displacement_px());
    if (tile.least_structure < pixels.least_structure) {
      pixels.least_structure = tile.least_structure;
      pixels.least_structure_at = tile.least_structure_at;
    }
  }
  const double all = static_cast<double>(pixels.baseline.width) * pixels.baseline.height;
  pixels.changed_share = all > 0.0 ? static_cast<double>(pixels.changed) / all : 0.0;
}

// The tolerances at which a judgement is made, from the defaults on.
constexpr std::array kNoiseSteps{
    ImageTolerances::kNoise, 3.0, 4.0, 6.0, 8.0, 12.0, 16.0, 24.0, 32.0, 48.0, 64.0};
constexpr std::array kDisplacementSteps{ImageTolerances::kDisplacement_px,
                                        0.5,
                                        0.6,
                                        0.7,
                                        0.8,
                                        0.9,
                                        1.0,
                                        1.25,
                                        1.5,
                                        1.75,
                                        2.0,
                                        2.5,
                                        3.0,
                                        3.5,
                                        4.0};

/// The steps up to a value, the largest first; the first step if the value is below all.
std::vector<double> steps_up_to(double value, std::span<const double> steps) {
  std::vector<double> found;
  for (const double step : steps)
    if (step <= value) found.insert(found.begin(), step);
  if (found.empty()) found.push_back(steps.front());
  return found;
}

/// What the options allow of a tile and its judgement did not know.
struct TileTolerance {
  /// @param judged  The tolerances of the judgement: at least the options', if these are below the
  ///                defaults, else at most theirs.
  TileTolerance(const ImageOptions& options, const ImageOptions& judged,
                const TileEvidence& evidence)
      : noise(options.noise),
        is_flat_shift(evidence.flat_shift > 0.0),
        is_moved_too_far(options.displacement_px < judged.displacement_px &&
                         evidence.displacement_px() > options.displacement_px) {}

  double noise;
  bool is_flat_shift;
  bool is_moved_too_far;
};

void apply_tolerance(const Image& baseline, const Image& current, const PixelBox& tile,
                     const TileTolerance& allowed, TileMarks& marks) {
  for (int y = 0; y < tile.height; ++y)
    for (int x = 0; x < tile.width; ++x) {
      PixelMark& mark = marks[y * kTile + x];
      if (mark == PixelMark::kEqual) continue;
      const int difference = largest_difference(baseline.row(tile.y + y)[tile.x + x],
                                                current.row(tile.y + y)[tile.x + x]);
      if (mark == PixelMark::kChanged && !allowed.is_flat_shift && difference <= allowed.noise)
        mark = PixelMark::kNoise;
      else if ((mark == PixelMark::kNoise && difference > allowed.noise) ||
               (mark == PixelMark::kSmoothed && allowed.is_moved_too_far))
        mark = PixelMark::kChanged;
    }
}

/// Leaves no evidence of a change in tiles that rounding of colours explains.
void forget_rounding(const Image& baseline, const Image& current, const std::vector<int>& tiles,
                     int across, std::vector<TileEvidence>& evidence) {
  if (std::ranges::none_of(evidence, [](const auto& tile) { return tile.flat_shift > 0.0; }))
    return;
  const std::vector<bool> rounded = rounded_tiles(baseline, current, tiles, across);
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    if (!rounded[i]) continue;
    TileEvidence rest;
    rest.differing = evidence[i].differing;
    rest.least_structure = evidence[i].least_structure;
    rest.least_structure_at = evidence[i].least_structure_at;
    rest.largest_colour_difference = evidence[i].largest_colour_difference;
    evidence[i] = rest;
  }
}

/// Fills in the marks and the sums of two images of one size.
/// @param judged  The tolerances of the judgement; what else the options allow is applied to its
///                marks.
/// @return Whether something is drawn on flat ground, which is a change whatever the judgement.
bool judge_pixels(const Image& baseline, const Image& current, const ImageOptions& options,
                  const ImageOptions& judged, PixelComparison& diff) {
  diff.marks = ChangeMap(baseline.width, baseline.height);

  // First pass: which tiles differ, and whether there is noise everywhere.
  const std::vector<TileStyle> styles = styles_at(baseline, current, diff.marks, judged.noise);
  std::vector<int> tiles;
  Texture texture;
  double within_noise = 0.0;
  for (std::size_t i = 0; i < styles.size(); ++i) {
    if (styles[i].differs) tiles.push_back(static_cast<int>(i));
    within_noise += styles[i].within_noise;
    texture.tiles += styles[i].is_textured;
    if (!styles[i].has_contrast) continue;
    texture.bounds.add(static_cast<int>(i) % diff.marks.across(),
                       static_cast<int>(i) / diff.marks.across());
  }
  const double pixels = static_cast<double>(baseline.width) * baseline.height;
  const EvidenceBounds bounds{judged.noise, judged.mean_noise, judged.displacement_px,
                              within_noise > kNoisyShare * pixels};
  diff.marks.keep(tiles);

  // Second pass: the evidence of each differing tile, then the judgement of all together.
  std::vector<TileEvidence> evidence(tiles.size());
  parallel_for(tiles.size(), [&](std::size_t i) {
    const PixelBox tile = box_of(diff.marks, baseline, tiles[i]);
    evidence[i] = tile_evidence(baseline, current, tile, bounds, *diff.marks.tile(tiles[i]));
  });
  forget_rounding(baseline, current, tiles, diff.marks.across(), evidence);
  judge(tiles, evidence, texture, judged, diff.marks);
  if (options.noise != judged.noise || options.displacement_px != judged.displacement_px)
    parallel_for(tiles.size(), [&](std::size_t i) {
      apply_tolerance(baseline, current, box_of(diff.marks, baseline, tiles[i]),
                      {options, judged, evidence[i]}, *diff.marks.tile(tiles[i]));
    });
  const bool any_drawn = mark_drawing_on_flat_ground(baseline, current, tiles, options, diff.marks);
  sum_up(tiles, evidence, diff.marks, diff.pixels);
  ChangedClusters clusters(diff.pixels.baseline);
  clusters.add(diff.marks, 0, diff.marks.down(), 0);
  clusters.sum_up(diff.pixels);
  return any_drawn;
}

}  // namespace

bool have_common_part(const ImageSize& a, const ImageSize& b) {
  constexpr int kFew = kTile;  // Pixels: what a window of the comparison can hold.
  return std::abs(a.width - b.width) <= kFew && std::abs(a.height - b.height) <= kFew;
}

Image upper_left(const Image& image, const ImageSize& size) {
  if (image.width == size.width && image.height == size.height) return image;
  Image part{size.width, size.height, {}};
  part.pixels.reserve(static_cast<std::size_t>(size.width) * size.height);
  for (int y = 0; y < size.height; ++y)
    part.pixels.insert(part.pixels.end(), image.row(y), image.row(y) + size.width);
  return part;
}

PixelComparison pixel_diff(const Image& baseline, Image current, const ImageOptions& options) {
  if (const std::string problem = problem_of(options); !problem.empty())
    throw InvalidInput(problem);
  PixelComparison diff;
  diff.pixels.baseline = {baseline.width, baseline.height};
  diff.pixels.current = {current.width, current.height};
  if (diff.pixels.baseline != diff.pixels.current) {
    if (!have_common_part(diff.pixels.baseline, diff.pixels.current)) return diff;
    const ImageSize common{std::min(baseline.width, current.width),
                           std::min(baseline.height, current.height)};
    PixelComparison of_part =
        pixel_diff(upper_left(baseline, common), upper_left(current, common), options);
    of_part.pixels.baseline = diff.pixels.baseline;
    of_part.pixels.current = diff.pixels.current;
    return of_part;
  }
  diff.pixels.ignored = ignore(baseline, current, options.ignored);
  // The judgement weighs shares of what differs, which a larger tolerance changes in either
  // direction. The judgement that finds least at any tolerance up to the allowed one cannot find
  // more if more is allowed.
  std::optional<PixelComparison> least;
  for (const double noise : steps_up_to(options.noise, kNoiseSteps))
    for (const double displacement_px : steps_up_to(options.displacement_px, kDisplacementSteps)) {
      ImageOptions judged = options;
      judged.noise = noise, judged.displacement_px = displacement_px;
      PixelComparison found = diff;
      const bool is_change = judge_pixels(baseline, current, options, judged, found);
      if (!least || found.pixels.changed < least->pixels.changed) least = std::move(found);
      // No other step can find none; how many pixels changed matters if a share of them may.
      if (least->pixels.changed == 0 || (is_change && options.changed_share == 0.0))
        return *std::move(least);
    }
  return *std::move(least);
}

namespace {

constexpr int kAbove = 2 * kTile;       // Rows above a strip. The lower half of them is judged with
constexpr int kOwnedAbove = kTile;      // it, the upper half with the strip before.
constexpr int kFewestRows = 4 * kTile;  // Of a strip.

std::int64_t pixels_of(const ImageSize& size) { return std::int64_t{size.width} * size.height; }

ImageSize size_of(const Image& image) { return {image.width, image.height}; }

Image cut(Image image, const ImageSize& size) {
  return size_of(image) == size ? std::move(image) : upper_left(image, size);
}

/// Puts an image below another of its width. @param above  Or of no rows.
Image below(Image above, Image image) {
  if (above.height == 0) return image;
  above.pixels.insert(above.pixels.end(), image.pixels.begin(), image.pixels.end());
  above.height += image.height;
  return above;
}

Image last_rows(const Image& image, int count) {
  const int rows = std::min(count, image.height);
  Image part{image.width, rows, {}};
  part.pixels.assign(image.row(image.height - rows), image.row(0) + image.pixels.size());
  return part;
}

/// The options of a strip that begins at row `from`.
ImageOptions moved(ImageOptions options, int from) {
  for (PixelBox& box : options.ignored) {
    const int hidden = std::clamp(from - box.y, 0, std::max(box.height, 0));
    box.height -= hidden;
    box.y = std::max(box.y - from, 0);
  }
  std::erase_if(options.ignored, [](const PixelBox& box) { return box.height == 0; });
  return options;
}

/// The pixels in any box, in rows `from` to `to` - 1 of an image.
std::int64_t pixels_in(const std::vector<PixelBox>& boxes, int width, int from, int to) {
  std::int64_t count = 0;
  for (int y = from; !boxes.empty() && y < to; ++y) {
    std::vector<bool> is_in(static_cast<std::size_t>(width), false);
    for (const PixelBox& box : boxes) {
      if (y < box.y || y - box.y >= box.height) continue;
      const std::int64_t right = std::min<std::int64_t>(std::int64_t{box.x} + box.width, width);
      for (std::int64_t x = std::max(box.x, 0); x < right; ++x) is_in[x] = true;
    }
    count += std::ranges::count(is_in, true);
  }
  return count;
}

}  // namespace

StripDiff::StripDiff(const ImageSize& baseline, const ImageSize& current,
                     const ImageOptions& options, bool with_heat, const StripLimits& limits)
    : size_{std::min(baseline.width, current.width), std::min(baseline.height, current.height)},
      options_(&options),
      with_heat_(with_heat),
      limits_(limits),
      clusters_(size_) {
  pixels_.baseline = baseline, pixels_.current = current;
  if (baseline != current && !have_common_part(baseline, current)) {
    with_heat_ = false;
    return;
  }
  while (pixels_of(size_) > limits.whole && heat_scale_ < kTile &&
         pixels_of(size_) / (heat_scale_ * heat_scale_) > limits.heat)
    heat_scale_ *= 2;
  plan();
}

void StripDiff::plan() {
  const int left = size_.height - rows_done_;
  if (pixels_of(size_) <= limits_.whole) {
    next_rows_ = left;
    return;
  }
  const auto rows = static_cast<int>(limits_.strip / size_.width) / kTile * kTile;
  next_rows_ = std::min(left, std::max(rows, kFewestRows));
  // A last strip of few rows joins the one before.
  if (left - next_rows_ < kFewestRows) next_rows_ = left;
}

void StripDiff::add(Image baseline, Image current) {
  const ImageSize taken{size_.width, next_rows_};
  rows_done_ += next_rows_;
  Image before = below(std::move(above_baseline_), cut(std::move(baseline), taken));
  Image after = below(std::move(above_current_), cut(std::move(current), taken));
  const int top = rows_done_ - before.height;  // Of the strip, in the image.
  const bool is_last = rows_done_ == size_.height;
  above_baseline_ = is_last ? Image{} : last_rows(before, kAbove);
  above_current_ = is_last ? Image{} : last_rows(after, kAbove);
  const ImageOptions options = moved(*options_, top);
  is_hidden_ = is_hidden_ || (!options.ignored.empty() && before.pixels != after.pixels);
  const PixelComparison found = pixel_diff(before, std::move(after), options);
  const int owned_to = is_last ? size_.height : rows_done_ - kOwnedAbove;
  take_over(found, top, owned_to);
  if (with_heat_ && found.pixels.differing > 0) any_heat_ = true;
  if (with_heat_)
    add_heat(heat_map(before, size_of(before), found.marks), rows_owned_ - top, owned_to - top);
  rows_owned_ = owned_to;
  plan();
}

void StripDiff::take_over(const PixelComparison& part, int top, int owned_to) {
  const int from = (rows_owned_ - top) / kTile, to = (owned_to - top + kTile - 1) / kTile;
  for (int tile = from * part.marks.across(); tile < to * part.marks.across(); ++tile)
    if (const TileMarks* marks = part.marks.tile(tile)) {
      pixels_.differing += kTile * kTile - std::ranges::count(*marks, PixelMark::kEqual);
      pixels_.changed += std::ranges::count(*marks, PixelMark::kChanged);
      pixels_.antialiased += std::ranges::count(*marks, PixelMark::kSmoothed);
    }
  clusters_.add(part.marks, from, to, top / kTile);
  pixels_.ignored += pixels_in(options_->ignored, size_.width, rows_owned_, owned_to);
  const PixelDiff& found = part.pixels;
  pixels_.largest_colour_difference =
      std::max(pixels_.largest_colour_difference, found.largest_colour_difference);
  pixels_.largest_mean_shift = std::max(pixels_.largest_mean_shift, found.largest_mean_shift);
  pixels_.largest_displacement_px =
      std::max(pixels_.largest_displacement_px, found.largest_displacement_px);
  if (found.least_structure >= pixels_.least_structure) return;
  pixels_.least_structure = found.least_structure;
  pixels_.least_structure_at = found.least_structure_at;
  pixels_.least_structure_at.y += top;
}

PixelDiff StripDiff::pixels() const {
  PixelDiff all = pixels_;
  const auto count = static_cast<double>(pixels_of(size_));
  all.changed_share = count > 0.0 ? static_cast<double>(all.changed) / count : 0.0;
  clusters_.sum_up(all);
  return all;
}

HeatMap StripDiff::heat() && { return any_heat_ ? std::move(heat_) : HeatMap{}; }

void StripDiff::add_heat(HeatMap part, int from, int to) {
  if (heat_scale_ == 1 && from == 0 && to == part.height && heat_.height == 0) {
    heat_ = std::move(part);
  } else if (heat_scale_ == 1) {
    append_rows(part, from, to, heat_);
  } else {
    HeatMap owned;
    append_rows(part, from, to, owned);
    const HeatMap small = reduced(owned, heat_scale_);
    append_rows(small, 0, small.height, heat_);
  }
}

}  // namespace mapproof
