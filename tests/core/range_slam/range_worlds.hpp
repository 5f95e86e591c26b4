#pragma once

#include <algorithm>
#include <vector>

#include "core/base/random.hpp"
#include "core/model/points.hpp"
#include "core/model/status.hpp"

namespace mapproof::test {

/// n points uniform in the square of half width `reach` about `center`.
inline Points points_about(Eigen::Index n, Random& random, double reach = 10.0,
                           const Eigen::RowVector2d& center = Eigen::RowVector2d::Zero()) {
  Points points(n, 2);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < 2; ++k) points(i, k) = center(k) + random.uniform(-reach, reach);
  return points;
}

/// Distances of landmarks (rows) to positions (columns).
inline Eigen::MatrixXd ranges_between(const Points& landmarks, const Points& positions) {
  Eigen::MatrixXd ranges(landmarks.rows(), positions.rows());
  for (Eigen::Index t = 0; t < positions.rows(); ++t)
    ranges.col(t) = (landmarks.rowwise() - positions.row(t)).rowwise().norm();
  return ranges;
}

/// One under the other.
inline Points stacked(const Points& above, const Points& below) {
  Points both(above.rows() + below.rows(), 2);
  both << above, below;
  return both;
}

inline bool has(const std::vector<Status>& statuses, StatusCode code) {
  return std::ranges::any_of(statuses, [&](const Status& status) { return status.code == code; });
}

}  // namespace mapproof::test
