#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// Landmarks of a square room in cells, so that those near a position are found without going
/// through all.
class LandmarkGrid {
 public:
  /// @param radius_m  > 0, of the neighbourhoods that will be asked for, about.
  LandmarkGrid(double side_m, double radius_m)
      : cells_on_side_(static_cast<std::ptrdiff_t>(std::clamp(side_m / radius_m, 1.0, 1024.0))),
        per_m_(static_cast<double>(cells_on_side_) / side_m),
        cells_(static_cast<std::size_t>(cells_on_side_ * cells_on_side_)) {}

  LandmarkGrid(const Points& landmarks_m, double side_m, double radius_m)
      : LandmarkGrid(side_m, radius_m) {
    for (Eigen::Index i = 0; i < landmarks_m.rows(); ++i)
      add(i, landmarks_m(i, 0), landmarks_m(i, 1));
  }

  void add(Eigen::Index landmark, double x, double y) {
    cells_[static_cast<std::size_t>(cell(x) * cells_on_side_ + cell(y))].push_back(landmark);
  }

  /// Calls work(landmark) for each that may lie within the radius, in any order, until one returns
  /// true. @return Whether one did.
  template <typename Work>
  bool any_near(double x, double y, double radius_m, const Work& work) const {
    const double reach_m = radius_m * (1.0 + 1e-9);  // More than sums are rounded by.
    const std::ptrdiff_t last_x = cell(x + reach_m), last_y = cell(y + reach_m);
    for (std::ptrdiff_t i = cell(x - reach_m); i <= last_x; ++i)
      for (std::ptrdiff_t j = cell(y - reach_m); j <= last_y; ++j)
        for (const Eigen::Index landmark : cells_[static_cast<std::size_t>(i * cells_on_side_ + j)])
          if (work(landmark)) return true;
    return false;
  }

 private:
  /// Positions outside of the room are of its outermost cells.
  std::ptrdiff_t cell(double x) const {
    const double at = std::floor(x * per_m_);
    return static_cast<std::ptrdiff_t>(
        std::clamp(at, 0.0, static_cast<double>(cells_on_side_ - 1)));
  }

  std::ptrdiff_t cells_on_side_;
  double per_m_;
  std::vector<std::vector<Eigen::Index>> cells_;
};

}  // namespace mapproof
