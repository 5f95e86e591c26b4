#include "core/range_slam/landmarks_on_path.hpp"

#include <cmath>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/planarity.hpp"

namespace mapproof {
namespace {

/// A share of |p|^2/2 that is as little as this beside [1, p] does not tell the scale.
constexpr double kCircular = 1e-6;

}  // namespace

LandmarksOnPath landmarks_on_path(const Points& positions_m, const Eigen::MatrixXd& Y) {
  if (Y.cols() != positions_m.rows()) throw InvalidInput("a column of ranges for each position");
  if (!positions_m.allFinite() || !Y.allFinite())
    throw InvalidInput("landmarks on a path need finite ranges and positions");
  if (!(planarity(positions_m) > kFlatPlanarity))
    throw InvalidInput("landmarks are not told by a path on one line");

  // About the path's centre, where the columns are nearly at right angles.
  const Eigen::RowVector2d center = positions_m.colwise().mean();
  Eigen::MatrixXd A(positions_m.rows(), 3);
  A << Eigen::VectorXd::Ones(positions_m.rows()), positions_m.rowwise() - center;
  const Eigen::VectorXd q = 0.5 * A.rightCols(2).rowwise().squaredNorm();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);

  // What of Y and q no [1, p] explains: their ratio is b.
  const Eigen::MatrixXd of_ranges = qr.solve(Y.transpose());
  const Eigen::VectorXd of_q = qr.solve(q);
  const Eigen::VectorXd rest = q - A * of_q;
  LandmarksOnPath result;
  double b = 1.0;
  if (rest.squaredNorm() > kCircular * q.squaredNorm()) {
    const Eigen::VectorXd mean = Y.colwise().mean().transpose();
    b = rest.dot(mean) / rest.squaredNorm();
  }
  if (!(b > 0.0)) b = 1.0;
  result.range_scale = std::sqrt(b);
  const Eigen::MatrixXd coefficients = of_ranges.colwise() - b * of_q;
  result.landmarks_m = (-1.0 / b) * coefficients.bottomRows(2).transpose();
  result.landmarks_m.rowwise() += center;
  return result;
}

}  // namespace mapproof
