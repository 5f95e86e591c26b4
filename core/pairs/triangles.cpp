#include "core/pairs/triangles.hpp"

#include <algorithm>

#include "core/base/not_finite.hpp"

namespace mapproof {

std::vector<bool> against_triangles(const std::vector<MeasuredPair>& pairs, Eigen::Index landmarks,
                                    double slack) {
  Eigen::MatrixXd sides = Eigen::MatrixXd::Constant(landmarks, landmarks, kNaN);
  for (const MeasuredPair& pair : pairs)
    sides(pair.first, pair.second) = sides(pair.second, pair.first) = pair.distance_m;

  std::vector<bool> result;
  for (const MeasuredPair& pair : pairs) {
    const auto a = sides.col(pair.first).array();
    const auto b = sides.col(pair.second).array();
    const Eigen::ArrayXd longest = a.max(b).max(pair.distance_m);
    // What one side is longer than the other two together; NaN where one is not known.
    const Eigen::ArrayXd gap = 2.0 * longest - a - b - pair.distance_m;
    const Eigen::Index triangles = (gap == gap).count();
    const Eigen::Index broken = (gap > slack * longest).count();
    result.push_back(broken >= 2 && 2 * broken > triangles);
  }
  return result;
}

}  // namespace mapproof
