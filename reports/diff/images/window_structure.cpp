#include "reports/diff/images/window_structure.hpp"

#include <algorithm>

namespace mapproof {
namespace {

constexpr int kWindow = 8;
constexpr int kStride = 4;

/// 0 to 255 [BT.601].
int luma(const Patch& patch, int cell) {
  return (77 * patch.raw[0][cell] + 150 * patch.raw[1][cell] + 29 * patch.raw[2][cell]) >> 8;
}

double structure(const PatchPair& pair, const WindowStructure& window) {
  int sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
  for (int y = window.y; y < window.y + window.height; ++y)
    for (int x = window.x; x < window.x + window.width; ++x) {
      const int a = luma(pair.before, cell_at(x, y)), b = luma(pair.after, cell_at(x, y));
      sum_a += a, sum_b += b;
      sum_aa += a * a, sum_bb += b * b, sum_ab += a * b;
    }
  constexpr double kC1 = 0.01 * 255 * 0.01 * 255, kC2 = 0.03 * 255 * 0.03 * 255;
  const double n = window.width * window.height;
  const double mean_a = sum_a / n, mean_b = sum_b / n;
  const double var_a = sum_aa / n - mean_a * mean_a, var_b = sum_bb / n - mean_b * mean_b;
  const double covariance = sum_ab / n - mean_a * mean_b;
  return (2 * mean_a * mean_b + kC1) * (2 * covariance + kC2) /
         ((mean_a * mean_a + mean_b * mean_b + kC1) * (var_a + var_b + kC2));
}

}  // namespace

WindowStructure least_window_structure(const PatchPair& pair, int width, int height) {
  WindowStructure least{1.0, 0, 0, std::min(kWindow, width), std::min(kWindow, height)};
  for (int y = 0; y < height; y += kStride)
    for (int x = 0; x < width; x += kStride) {
      WindowStructure window{1.0, x, y, std::min(kWindow, width - x),
                             std::min(kWindow, height - y)};
      window.structure = structure(pair, window);
      if (window.structure < least.structure) least = window;
    }
  return least;
}

}  // namespace mapproof
