#include "core/align/affine.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

Affine weighted_least_squares(const Points& from, const Points& to,
                              const Eigen::VectorXd& weights) {
  const Eigen::RowVector2d from_center = weights.transpose() * from / weights.sum();
  const Eigen::RowVector2d to_center = weights.transpose() * to / weights.sum();
  const Eigen::VectorXd roots = weights.cwiseSqrt();
  const Points A = roots.asDiagonal() * (from.rowwise() - from_center);
  const Points B = roots.asDiagonal() * (to.rowwise() - to_center);
  Affine affine;
  affine.linear = A.colPivHouseholderQr().solve(B);
  affine.offset = to_center - from_center * affine.linear;
  return affine;
}

/// Through four points the residuals of any affine map are one vector divided by the points' affine
/// dependency c (sum c_i = 0, sum c_i from_i = 0): the least sum puts all of it on the point of the
/// largest |c_i| and meets the other three.
Affine through_three_of_four(const Points& from, const Points& to) {
  Eigen::Matrix<double, 4, 3> rows;
  rows << from.rowwise() - from.colwise().mean(), Eigen::Vector4d::Ones();
  const Eigen::Matrix4d Q = rows.fullPivHouseholderQr().matrixQ();
  Eigen::Index left_out = 0;
  Q.col(3).cwiseAbs().maxCoeff(&left_out);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(4);
  weights(left_out) = 0.0;
  return weighted_least_squares(from, to, weights);
}

double sum_of_distances(const Affine& affine, const Points& from, const Points& to) {
  return (affine(from) - to).rowwise().norm().sum();
}

}  // namespace

Affine fit_affine(const Points& from, const Points& to, AffineFit fit) {
  const Eigen::Index n = from.rows();
  if (n < 3 || to.rows() != n) throw InvalidInput("an affine map needs 3 pairs of points or more");
  if (!from.allFinite() || !to.allFinite()) throw InvalidInput("an affine map needs finite points");
  if (planarity(from) <= 1e-9)
    throw InvalidInput("an affine map needs points that do not lie on one line");

  Affine best = weighted_least_squares(from, to, Eigen::VectorXd::Ones(n));
  if (fit == AffineFit::kLeastSquares || n == 3) return best;

  if (n == 4) return through_three_of_four(from, to);

  // Each weight is the inverse of the last residual, floored ever lower: the floor keeps the
  // weights of points that are met exactly finite.
  const double spread = (to.rowwise() - to.colwise().mean()).rowwise().norm().maxCoeff();
  double lowest = sum_of_distances(best, from, to);
  Affine current = best;
  for (double floor = 1e-1 * spread; floor > 1e-9 * spread; floor *= 0.5) {
    const double before = lowest;
    for (int repeat = 0; repeat < 4; ++repeat) {
      const Eigen::ArrayXd residuals = (current(from) - to).rowwise().norm().array();
      current = weighted_least_squares(from, to, (residuals.square() + floor * floor).rsqrt());
    }
    const double sum = sum_of_distances(current, from, to);
    if (sum < lowest) {
      lowest = sum;
      best = current;
    }
    if (floor < 1e-3 * spread && lowest > before * (1.0 - 1e-13)) break;
  }
  return best;
}

}  // namespace mapproof
