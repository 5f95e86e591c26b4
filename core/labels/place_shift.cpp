#include "core/labels/place_shift.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/random.hpp"

namespace mapproof {
namespace {

constexpr int kPlainlyLarge = 100;  ///< Permutations with as much, after which no more are drawn.

/// What the best shift over some slices lowers the cost by: g' H^-1 g / 2.
double fall(const ShiftSlice& sum) {
  // A direction that no pair measures must not count; its curvature is nothing but rounding.
  const double ridge = 1e-9 * sum.H.trace();
  const double a = sum.H(0, 0) + ridge;
  const double b = sum.H(0, 1);
  const double c = sum.H(1, 1) + ridge;
  const double determinant = a * c - b * b;
  if (!(determinant > 0.0)) return 0.0;
  return 0.5 * (c * sum.g(0) * sum.g(0) - 2.0 * b * sum.g(0) * sum.g(1) + a * sum.g(1) * sum.g(1)) /
         determinant;
}

struct Split {
  double gain = 0.0;
  std::size_t first = 0;  ///< Slice of the second place.
};

/// The split with the greatest gain; a place stands on two slices or more.
Split best_split(const std::vector<ShiftSlice>& slices) {
  ShiftSlice all;
  for (const ShiftSlice& slice : slices) {
    all.H += slice.H;
    all.g += slice.g;
  }
  const double together = fall(all);
  Split best;
  ShiftSlice before;
  for (std::size_t k = 0; k + 2 < slices.size(); ++k) {
    before.H += slices[k].H;
    before.g += slices[k].g;
    if (k == 0) continue;
    const double gain = fall(before) + fall({all.H - before.H, all.g - before.g}) - together;
    if (gain > best.gain) best = {gain, k + 1};
  }
  return best;
}

}  // namespace

std::vector<ShiftSlice> shift_slices(const std::vector<PairItem>& items, const RobustMap& map,
                                     const LogBlocks& blocks, int landmark) {
  const int count = blocks.slice.empty() ? 0 : *std::ranges::max_element(blocks.slice) + 1;
  std::vector<ShiftSlice> slices(static_cast<std::size_t>(count));
  for (const PairItem& item : items) {
    if (item.first != landmark && item.second != landmark) continue;
    const int partner = item.first == landmark ? item.second : item.first;
    const Eigen::RowVector2d away = map.positions_m.row(landmark) - map.positions_m.row(partner);
    const double distance = away.norm();
    if (!(distance > 0.0)) continue;  // an unmapped partner's is NaN
    const Eigen::Vector2d direction = away.transpose() / distance;
    const double residual = item.distance_m - distance;
    const double weight =
        item.weight * std::min(1.0, map.width_m / std::max(std::abs(residual), 1e-300));
    ShiftSlice& slice =
        slices[static_cast<std::size_t>(blocks.slice[static_cast<std::size_t>(item.block)])];
    slice.H += weight * direction * direction.transpose();
    slice.g += weight * residual * direction;
  }
  return slices;
}

std::size_t likeliest_change(const std::vector<ShiftSlice>& slices) {
  return best_split(slices).first;
}

ShiftTest shift_test(const std::vector<ShiftSlice>& slices, const PermutationOptions& options) {
  // Slices that do not show the landmark would only lengthen the series.
  std::vector<ShiftSlice> shuffled = slices;
  std::erase_if(shuffled, [](const ShiftSlice& slice) { return slice.H.trace() == 0.0; });
  ShiftTest test{best_split(shuffled).gain, 1.0};
  if (shuffled.size() < 6) return test;
  Random random(options.seed);
  int as_much = 1;
  int drawn = 1;
  while (drawn <= options.count && as_much < kPlainlyLarge) {
    for (std::size_t k = shuffled.size(); k-- > 1;)
      std::swap(shuffled[k],
                shuffled[static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1))]);
    as_much += best_split(shuffled).gain >= test.statistic ? 1 : 0;
    ++drawn;
  }
  test.p = static_cast<double>(as_much) / drawn;
  return test;
}

}  // namespace mapproof
