#include "core/linalg/centering.hpp"

namespace mapproof {

Eigen::MatrixXd double_centered(const Eigen::MatrixXd& squared_distances) {
  const Eigen::VectorXd means = squared_distances.rowwise().mean();
  Eigen::MatrixXd B = squared_distances;
  B.colwise() -= means;
  B.rowwise() -= means.transpose();
  B.array() += means.mean();
  return -0.5 * B;
}

}  // namespace mapproof
