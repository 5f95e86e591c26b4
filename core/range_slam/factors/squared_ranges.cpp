#include "core/range_slam/factors/squared_ranges.hpp"

#include "core/base/errors.hpp"

namespace mapproof {

Eigen::MatrixXd half_squared_ranges(const Eigen::MatrixXd& ranges_m, const RangeNoise& noise) {
  if (!(noise.sigma_m >= 0.0) || !(noise.share >= 0.0))
    throw InvalidInput("the noise of ranges must not be negative");
  if (!ranges_m.allFinite()) throw InvalidInput("ranges must be finite");
  const double growth = 1.0 + noise.share * noise.share;
  Eigen::MatrixXd Y = 0.5 * (ranges_m.array().square() - noise.sigma_m * noise.sigma_m) / growth;
  if (!Y.allFinite()) throw InvalidInput("a squared range overflows");
  return Y;
}

Eigen::VectorXd half_square_variances(const Eigen::MatrixXd& Y, const RangeNoise& noise) {
  const double growth = 1.0 + noise.share * noise.share;
  const Eigen::ArrayXXd squares = 2.0 * Y.array().max(0.0);
  const Eigen::ArrayXXd s2 = noise.sigma_m * noise.sigma_m + noise.share * noise.share * squares;
  return ((squares * s2 + 0.5 * s2.square()) / (growth * growth)).rowwise().mean();
}

Eigen::MatrixXd landmark_states(const Eigen::MatrixXd& landmarks_m) {
  Eigen::MatrixXd C(landmarks_m.rows(), landmarks_m.cols() + 2);
  C << 0.5 * landmarks_m.rowwise().squaredNorm(), landmarks_m,
      Eigen::VectorXd::Ones(landmarks_m.rows());
  return C;
}

Eigen::MatrixXd robot_states(const Eigen::MatrixXd& positions_m) {
  const Eigen::Index d = positions_m.cols();
  Eigen::MatrixXd X(d + 2, positions_m.rows());
  X.row(0).setOnes();
  X.middleRows(1, d) = -positions_m.transpose();
  X.row(d + 1) = 0.5 * positions_m.rowwise().squaredNorm().transpose();
  return X;
}

}  // namespace mapproof
