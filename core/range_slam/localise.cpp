#include "core/range_slam/localise.hpp"

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/planarity.hpp"

namespace mapproof {

Points localise(const Points& landmarks_m, const Eigen::MatrixXd& Y) {
  if (Y.rows() != landmarks_m.rows()) throw InvalidInput("a row of ranges for each landmark");
  if (!landmarks_m.allFinite() || !Y.allFinite())
    throw InvalidInput("positions need finite landmarks and ranges");
  if (!(planarity(landmarks_m) > kFlatPlanarity))
    throw InvalidInput("positions need landmarks that span the plane");
  // About their centre: Y - |m|^2/2 = [m, 1] [-x, -y, (x^2 + y^2)/2].
  const Eigen::RowVector2d center = landmarks_m.colwise().mean();
  const Points offsets = landmarks_m.rowwise() - center;
  Eigen::MatrixX3d A(offsets.rows(), 3);
  A << offsets, Eigen::VectorXd::Ones(offsets.rows());
  const Eigen::MatrixXd right = Y.colwise() - 0.5 * offsets.rowwise().squaredNorm();
  const Eigen::MatrixXd states = A.colPivHouseholderQr().solve(right);
  return (-states.topRows(2).transpose()).rowwise() + center;
}

}  // namespace mapproof
