#include "reports/diff/image_diff.hpp"

#include <algorithm>
#include <cstring>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// Whether rows of the tile differ.
bool tile_differs(const Image& a, const Image& b, int x0, int y0) {
  const int count = std::min(kTile, a.width - x0), end = std::min(y0 + kTile, a.height);
  for (int y = y0; y < end; ++y)
    if (std::memcmp(a.row(y) + x0, b.row(y) + x0, 4 * static_cast<std::size_t>(count)) != 0)
      return true;
  return false;
}

int largest_channel(std::uint32_t a, std::uint32_t b) {
  int most = 0;
  for (const int shift : {16, 8, 0})
    most = std::max(most, std::abs(static_cast<int>((a >> shift) & 0xFF) -
                                   static_cast<int>((b >> shift) & 0xFF)));
  return most;
}

}  // namespace

ImageDiff image_diff(const Image& baseline, const Image& current, const PictureOptions& options) {
  if (const std::string problem = options.problem(); !problem.empty()) throw InvalidInput(problem);
  ImageDiff diff;
  diff.pixels.baseline = {baseline.width, baseline.height};
  diff.pixels.current = {current.width, current.height};
  if (diff.pixels.baseline != diff.pixels.current) return diff;
  diff.marks = ChangeMap(baseline.width, baseline.height);
  std::vector<int> different;
  for (int i = 0; i < diff.marks.across() * diff.marks.down(); ++i)
    if (tile_differs(baseline, current, i % diff.marks.across() * kTile,
                     i / diff.marks.across() * kTile))
      different.push_back(i);
  diff.marks.keep(different);
  for (const int i : different) {
    const int x0 = i % diff.marks.across() * kTile, y0 = i / diff.marks.across() * kTile;
    for (int y = y0; y < std::min(y0 + kTile, baseline.height); ++y)
      for (int x = x0; x < std::min(x0 + kTile, baseline.width); ++x) {
        const int most = largest_channel(baseline.row(y)[x], current.row(y)[x]);
        if (most == 0) continue;
        ++diff.pixels.differing;
        const bool is_changed = most > options.noise;
        diff.pixels.changed += is_changed;
        (*diff.marks.tile(i))[(y - y0) * kTile + x - x0] =
            is_changed ? PixelMark::kChanged : PixelMark::kNoise;
      }
  }
  diff.pixels.changed_share = static_cast<double>(diff.pixels.changed) /
                              std::max(1.0, double(baseline.width) * baseline.height);
  return diff;
}

}  // namespace mapproof
