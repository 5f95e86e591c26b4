#include "reports/diff/images/filter_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace mapproof {
namespace {

using FloatPlane = std::array<float, kPatchCells>;

// Per axis, of the binomial filters of 3 and 5 pixels and of two of 5 pixels one after the other.
constexpr std::array kVariances_px2 = {0.5, 1.0, 2.0};

/// The binomial filter of 5 pixels along rows (step 1) or columns.
void binomial5(const FloatPlane& in, FloatPlane& out, int step) {
  out.fill(0.0F);
  for (int i = 2 * step; i < kPatchCells - 2 * step; ++i)
    out[i] = (in[i - 2 * step] + 4.0F * in[i - step] + 6.0F * in[i] + 4.0F * in[i + step] +
              in[i + 2 * step]) /
             16.0F;
}

/// A `smoother` plane, smoothed once more; of 255.
FloatPlane wide(const Plane& smoother) {
  FloatPlane plane, rows;
  for (int i = 0; i < kPatchCells; ++i)
    plane[i] = static_cast<float>(smoother[i]) / static_cast<float>(kSmootherScale);
  binomial5(plane, rows, 1);
  binomial5(rows, plane, kPatchSide);
  return plane;
}

bool is_near_beyond(const PatchPair& pair, int cell, double noise) {
  for (const int row : {cell - kPatchSide, cell, cell + kPatchSide})
    for (const int i : {row - 1, row, row + 1})
      if (pair.is_beyond(i, noise)) return true;
  return false;
}

}  // namespace

void FilterFit::add(const FilterFit& other) {
  for (std::size_t i = 0; i < products.size(); ++i) products[i] += other.products[i];
  for (std::size_t i = 0; i < right.size(); ++i) right[i] += other.right[i];
  energy += other.energy;
  values += other.values;
}

FilterFit::Filter FilterFit::filter() const {
  constexpr int kFewestValues = 64;  // Three numbers are fitted to them.
  constexpr double kRidge = 1e-3;    // The filters resemble each other.
  if (values < kFewestValues || energy == 0.0) return {};
  Eigen::Matrix3d normal;
  normal << products[0], products[1], products[2], products[1], products[3], products[4],
      products[2], products[4], products[5];
  const Eigen::Vector3d sums(right[0], right[1], right[2]);
  Eigen::Matrix3d damped = normal;
  damped.diagonal().array() += kRidge * normal.trace();
  const Eigen::Vector3d shares = damped.ldlt().solve(sums);
  const double left = energy - 2.0 * shares.dot(sums) + shares.dot(normal * shares);
  return {1.0 - left / energy,
          shares.dot(Eigen::Vector3d(kVariances_px2[0], kVariances_px2[1], kVariances_px2[2]))};
}

FilterFit filter_fit(const PatchPair& pair, double noise, int width, int height) {
  FilterFit fit;
  std::array<FloatPlane, 3> widest;
  for (int c = 0; c < 3; ++c) widest[c] = wide(pair.before.smoother[c]);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int i = cell_at(x, y);
      if (!is_near_beyond(pair, i, noise)) continue;
      for (int c = 0; c < 3; ++c) {
        const double before = pair.before.raw[c][i], after = pair.after.raw[c][i];
        if (after == 0.0 || after == 255.0) continue;
        const double near = pair.before.smooth[c][i] / double{kSmoothScale} - before;
        const double far = pair.before.smoother[c][i] / double{kSmootherScale} - before;
        const double farthest = widest[c][i] - before, difference = after - before;
        fit.products[0] += near * near, fit.products[1] += near * far;
        fit.products[2] += near * farthest, fit.products[3] += far * far;
        fit.products[4] += far * farthest, fit.products[5] += farthest * farthest;
        fit.right[0] += near * difference, fit.right[1] += far * difference;
        fit.right[2] += farthest * difference;
        fit.energy += difference * difference;
        ++fit.values;
      }
    }
  return fit;
}

}  // namespace mapproof
