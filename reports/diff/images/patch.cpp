#include "reports/diff/images/patch.hpp"

#include <algorithm>
#include <cstdlib>

namespace mapproof {
namespace {

void load(const Image& image, int x0, int y0, Patch& patch) {
  for (int y = 0; y < kPatchSide; ++y) {
    const std::uint32_t* row = image.row(std::clamp(y0 + y - kPatchMargin, 0, image.height - 1));
    for (int x = 0; x < kPatchSide; ++x) {
      const std::uint32_t pixel = row[std::clamp(x0 + x - kPatchMargin, 0, image.width - 1)];
      for (int c = 0; c < 3; ++c)
        patch.raw[c][y * kPatchSide + x] =
            static_cast<std::int16_t>((pixel >> (16 - 8 * c)) & 0xFF);
    }
  }
}

/// Applies `combine` to each cell and its neighbours, first along rows, then along columns.
template <typename Combine>
void separable(const Plane& in, Plane& out, Combine combine) {
  Plane rows;
  rows.front() = rows.back() = 0;
  for (int i = 1; i < kPatchCells - 1; ++i) rows[i] = combine(in[i - 1], in[i], in[i + 1]);
  std::fill_n(out.begin(), kPatchSide, std::int16_t{0});
  std::fill_n(out.end() - kPatchSide, kPatchSide, std::int16_t{0});
  for (int i = kPatchSide; i < kPatchCells - kPatchSide; ++i)
    out[i] = combine(rows[i - kPatchSide], rows[i], rows[i + kPatchSide]);
}

std::int16_t binomial(std::int16_t a, std::int16_t b, std::int16_t c) {
  return static_cast<std::int16_t>(a + 2 * b + c);
}
std::int16_t least(std::int16_t a, std::int16_t b, std::int16_t c) { return std::min({a, b, c}); }
std::int16_t most(std::int16_t a, std::int16_t b, std::int16_t c) { return std::max({a, b, c}); }

// Each has its own type, so that it is inlined into its loops.
constexpr auto kBinomial = [](auto... v) { return binomial(v...); };
constexpr auto kLeast = [](auto... v) { return least(v...); };
constexpr auto kMostOfNine = [](auto... v) { return most(v...); };

}  // namespace

void load_patch(const Image& image, int x0, int y0, Patch& patch) {
  load(image, x0, y0, patch);
  for (int c = 0; c < 3; ++c) {
    separable(patch.raw[c], patch.smooth[c], kBinomial);
    neighbour_bounds(patch.smooth[c], patch.low[c], patch.high[c]);
    Plane quarter;
    std::ranges::transform(patch.smooth[c], quarter.begin(),
                           [](std::int16_t v) { return static_cast<std::int16_t>(v / 4); });
    separable(quarter, patch.smoother[c], kBinomial);
  }
}

void neighbour_bounds(const Plane& plane, Plane& low, Plane& high) {
  separable(plane, low, kLeast);
  separable(plane, high, kMostOfNine);
}

int PatchPair::difference(int cell) const {
  int largest = 0;
  for (int c = 0; c < 3; ++c)
    largest = std::max(largest, std::abs(after.raw[c][cell] - before.raw[c][cell]));
  return largest;
}

}  // namespace mapproof
