#include "core/range_slam/heading.hpp"

#include <cmath>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kRankWithHeading = 7;
constexpr Eigen::Index kLeastLandmarksRank7 = 4;
constexpr Eigen::Index kLeastColumns = 8;

/// Directions from the bottom block: [m, 1] [-cos, -sin, ...]' by regression on the map.
Eigen::VectorXd headings(const Eigen::MatrixXd& bottom, const Points& landmarks_m) {
  Eigen::MatrixX3d A(landmarks_m.rows(), 3);
  A << landmarks_m, Eigen::VectorXd::Ones(landmarks_m.rows());
  const Eigen::MatrixXd states = A.colPivHouseholderQr().solve(bottom);
  Eigen::VectorXd heading_rad(states.cols());
  for (Eigen::Index t = 0; t < states.cols(); ++t)
    heading_rad(t) = std::atan2(-states(1, t), -states(0, t));
  return heading_rad;
}

}  // namespace

HeadingColumns heading_columns(const Eigen::MatrixXd& half_squares, const Eigen::VectorXd& moved_m,
                               double least_m) {
  const Eigen::Index N = half_squares.rows(), T = half_squares.cols();
  if (moved_m.size() + 1 != T) throw InvalidInput("a motion is needed between any two steps");
  if (!half_squares.allFinite() || !moved_m.allFinite())
    throw InvalidInput("ranges and motions must be finite");
  if (!(least_m > 0.0)) throw InvalidInput("the least motion must be above 0");
  HeadingColumns columns;
  for (Eigen::Index t = 0; t + 1 < T; ++t)
    if (std::abs(moved_m(t)) >= least_m) columns.steps.push_back(t);
  columns.Y.resize(2 * N, std::ssize(columns.steps));
  for (Eigen::Index k = 0; k < columns.Y.cols(); ++k) {
    const Eigen::Index t = columns.steps[static_cast<std::size_t>(k)];
    columns.Y.col(k) << half_squares.col(t),
        (half_squares.col(t + 1) - half_squares.col(t)) / moved_m(t);
  }
  return columns;
}

HeadingMap map_with_heading(const HeadingColumns& columns,
                            const std::optional<KnownLandmarks>& known) {
  const Eigen::Index N = columns.Y.rows() / 2, K = columns.Y.cols();
  HeadingMap result;
  if (N < kLeastLandmarksRank7 || K < kLeastColumns) {
    result.map.statuses.push_back(
        status_of<StatusReason::kFewStepsWithMotion>(N, K, kLeastLandmarksRank7, kLeastColumns));
    return result;
  }
  const Factorization factors = factorize(columns.Y, kRankWithHeading);
  const Factorization top = factorize(factors.U.topRows(N) * factors.V, 4);
  result.singular_values = factors.singular_values;
  result.map = known ? map_from_known_landmarks(top, *known) : metric_upgrade(top).map;
  result.map.statuses.insert(result.map.statuses.begin(), factors.statuses.begin(),
                             factors.statuses.end());
  if (!result.map.empty())
    result.heading_rad = headings(factors.U.bottomRows(N) * factors.V, landmarks_of(result.map.C));
  return result;
}

}  // namespace mapproof
