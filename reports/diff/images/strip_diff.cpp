#include "reports/diff/images/strip_diff.hpp"

#include <algorithm>
#include <vector>

#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/pixel_diff.hpp"

namespace mapproof {
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

/// The colour of a square of a heat map: that of a change before that of noise before the mean
/// grey.
std::uint32_t colour_of_square(const Image& part, int x0, int y0, int side) {
  std::uint32_t grey = 0, count = 0;
  bool is_noise = false;
  for (int y = y0; y < std::min(y0 + side, part.height); ++y)
    for (int x = x0; x < std::min(x0 + side, part.width); ++x) {
      const std::uint32_t pixel = part.row(y)[x];
      if (pixel == kChangedColour) return pixel;
      is_noise = is_noise || pixel == kNoiseColour;
      grey += pixel & 0xFF;
      ++count;
    }
  return is_noise ? kNoiseColour : grey / count * 0x010101u;
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
    add_heat(heat_map(std::move(before), found.marks), rows_owned_ - top, owned_to - top);
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

Image StripDiff::heat() && { return any_heat_ ? std::move(heat_) : Image{}; }

void StripDiff::add_heat(Image part, int from, int to) {
  if (heat_scale_ == 1 && from == 0 && to == part.height) {
    heat_ = std::move(part);
    return;
  }
  heat_.width = (size_.width + heat_scale_ - 1) / heat_scale_;
  for (int y = from; y < to; y += heat_scale_, ++heat_.height)
    for (int x = 0; x < size_.width; x += heat_scale_)
      heat_.pixels.push_back(colour_of_square(part, x, y, heat_scale_));
}

}  // namespace mapproof
