#include "reports/diff/images/tile_patch.hpp"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace mapproof {
namespace {

constexpr int kFarthest = 3;  // Pixels: with slopes, the most that the margin of a patch allows.
constexpr double kFarthestRest = 0.75;  // Beyond whole pixels.
constexpr std::size_t kMostStyles = 6;

/// Slope of a smoothed plane in 1 of 255 per pixel, from five cells.
double slope(const Plane& plane, int i, int step, int scale) {
  return (8 * (plane[i + step] - plane[i - step]) - (plane[i + 2 * step] - plane[i - 2 * step])) /
         (12.0 * scale);
}

/// The same planes of both images, red first.
struct PlanePair {
  const std::array<Plane, 3>& before;
  const std::array<Plane, 3>& after;
  int scale;  ///< The value in the planes of a difference of 1 of 255.
};

/// @param noise, offset, around  As in movement_fit().
MovementFit fit_of(const PlanePair& planes, double noise, int offset, int around) {
  const auto& [before, after, scale] = planes;
  MovementFit fit;
  for (int y = -around; y < kTile + around; ++y)
    for (int x = -around; x < kTile + around; ++x) {
      const int i = cell_at(x, y), j = i - offset;
      for (int c = 0; c < 3; ++c) {
        const Plane &a = before[c], &b = after[c];
        const double d = static_cast<double>(b[i] - a[j]) / scale;
        if (std::abs(d) <= noise) continue;
        const double gx = (slope(a, j, 1, scale) + slope(b, i, 1, scale)) / 2.0;
        const double gy = (slope(a, j, kPatchSide, scale) + slope(b, i, kPatchSide, scale)) / 2.0;
        fit.gxx += gx * gx, fit.gxy += gx * gy, fit.gyy += gy * gy;
        fit.gxd += gx * d, fit.gyd += gy * d, fit.energy += d * d;
      }
    }
  return fit;
}

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

void MovementFit::add(const MovementFit& other, double weight) {
  energy += weight * other.energy;
  gxx += weight * other.gxx, gxy += weight * other.gxy, gyy += weight * other.gyy;
  gxd += weight * other.gxd, gyd += weight * other.gyd;
}

std::array<double, 2> MovementFit::movement() const {
  const double ridge = 0.01 * (gxx + gyy) + 1e-9;
  const double xx = gxx + ridge, yy = gyy + ridge;
  const double determinant = xx * yy - gxy * gxy;
  return {-(yy * gxd - gxy * gyd) / determinant, -(xx * gyd - gxy * gxd) / determinant};
}

double MovementFit::left(double x, double y) const {
  const double left =
      energy + 2 * (x * gxd + y * gyd) + x * x * gxx + 2 * x * y * gxy + y * y * gyy;
  return std::max(left, 0.0);
}

MovementFit movement_fit(const PatchPair& pair, double noise, int offset, int around) {
  return fit_of({pair.before.smoother, pair.after.smoother, kSmootherScale}, noise, offset, around);
}

KeptShape kept_shape(const PatchPair& pair, double right_px, double down_px) {
  using Step = std::array<int, 2>;
  const auto whole = [](double right, double down) {
    const auto one = [](double px) {
      return static_cast<int>(std::lround(std::clamp(px, -1.0 * kFarthest, 1.0 * kFarthest)));
    };
    return Step{one(right), one(down)};
  };
  // Whole pixels first, then fractions. If that leads to other whole pixels, start again from
  // there.
  std::vector<Step> styles{{0, 0}};
  const auto look_at = [&](const Step& step) {
    if (std::ranges::find(styles, step) == styles.end()) styles.push_back(step);
  };
  look_at(whole(right_px, down_px));
  KeptShape kept;
  double energy = 0.0;
  for (std::size_t k = 0; k < std::min(styles.size(), kMostStyles); ++k) {
    const auto [right, down] = styles[k];
    const MovementFit fit = fit_of({pair.before.smooth, pair.after.smooth, kSmoothScale}, 1.0,
                                   down * kPatchSide + right, 0);
    if (k == 0) energy = fit.energy;
    if (energy == 0.0) return kept;
    auto [x, y] = fit.movement();
    const double part = std::min(1.0, kFarthestRest / std::max(std::hypot(x, y), 1e-9));
    x *= part, y *= part;
    const double left = fit.left(x, y) / energy;
    if (left >= kept.left) continue;
    kept = {left, right + x, down + y};
    if (k > 0) look_at(whole(right + x, down + y));
  }
  return kept;
}

}  // namespace mapproof
