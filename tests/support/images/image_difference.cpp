#include "tests/support/images/image_difference.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace mapproof::test {
namespace {

constexpr int kWindow = 8;
constexpr int kStride = 4;
constexpr int kNoticeable = 16;

int channel(std::uint32_t pixel, int shift) { return static_cast<int>((pixel >> shift) & 0xFF); }

bool differs(std::uint32_t a, std::uint32_t b) {
  for (const int shift : {16, 8, 0})
    if (std::abs(channel(a, shift) - channel(b, shift)) > kNoticeable) return true;
  return false;
}

/// One channel in one window of both images.
struct WindowStatistics {
  double mean_a = 0.0, mean_b = 0.0;
  double var_a = 0.0, var_b = 0.0, covariance = 0.0;

  double similarity() const {
    constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
    return (2 * mean_a * mean_b + c1) * (2 * covariance + c2) /
           ((mean_a * mean_a + mean_b * mean_b + c1) * (var_a + var_b + c2));
  }
};

WindowStatistics statistics(const Image& a, const Image& b, int x0, int y0, int shift) {
  const int x1 = std::min(x0 + kWindow, a.width), y1 = std::min(y0 + kWindow, a.height);
  double sum_a = 0.0, sum_b = 0.0, sum_aa = 0.0, sum_bb = 0.0, sum_ab = 0.0;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const double va = channel(a.row(y)[x], shift), vb = channel(b.row(y)[x], shift);
      sum_a += va;
      sum_b += vb;
      sum_aa += va * va;
      sum_bb += vb * vb;
      sum_ab += va * vb;
    }
  const double n = (x1 - x0) * (y1 - y0);
  const double mean_a = sum_a / n, mean_b = sum_b / n;
  return {mean_a, mean_b, sum_aa / n - mean_a * mean_a, sum_bb / n - mean_b * mean_b,
          sum_ab / n - mean_a * mean_b};
}

}  // namespace

ImageDifference image_difference(const Image& a, const Image& b) {
  ImageDifference difference;
  difference.same_size = a.width == b.width && a.height == b.height;
  if (!difference.same_size || a.width == 0 || a.height == 0) return difference;
  std::size_t changed = 0;
  const std::size_t pixels = static_cast<std::size_t>(a.width) * a.height;
  for (std::size_t i = 0; i < pixels; ++i)
    if (differs(a.pixels[i], b.pixels[i])) ++changed;
  difference.changed_share = static_cast<double>(changed) / static_cast<double>(pixels);
  difference.structure = 1.0;
  difference.shift = 0.0;
  for (int y = 0; y < a.height; y += kStride)
    for (int x = 0; x < a.width; x += kStride)
      for (const int shift : {16, 8, 0}) {
        const WindowStatistics window = statistics(a, b, x, y, shift);
        difference.structure = std::min(difference.structure, window.similarity());
        difference.shift = std::max(difference.shift, std::abs(window.mean_a - window.mean_b));
      }
  return difference;
}

bool is_alike(const ImageDifference& difference, const ImageTolerance& tolerance) {
  return difference.same_size && difference.changed_share <= tolerance.most_changed &&
         difference.structure >= tolerance.least_structure &&
         difference.shift <= tolerance.most_shift;
}

}  // namespace mapproof::test
