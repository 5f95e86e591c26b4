#include "core/linalg/centering.hpp"

namespace mapproof {

Eigen::MatrixXd centered(Eigen::MatrixXd matrix) {
  const Eigen::VectorXd means = matrix.rowwise().mean();
  matrix.colwise() -= means;
  matrix.rowwise() -= means.transpose();
  matrix.array() += means.mean();
  return matrix;
}

Eigen::MatrixXd double_centered(const Eigen::MatrixXd& squared_distances) {
  return centered(-0.5 * squared_distances);
}

}  // namespace mapproof
