#include "core/linalg/centering.hpp"

#include <utility>

#include "core/linalg/unset_matrix.hpp"

namespace mapproof {

Eigen::MatrixXd centered(Eigen::MatrixXd matrix) {
  const Eigen::VectorXd means = matrix.rowwise().mean();
  matrix.colwise() -= means;
  matrix.rowwise() -= means.transpose();
  matrix.array() += means.mean();
  return matrix;
}

Eigen::MatrixXd double_centered(const Eigen::MatrixXd& squared_distances) {
  Eigen::MatrixXd half = unset_matrix(squared_distances.rows(), squared_distances.cols());
  half = -0.5 * squared_distances;
  return centered(std::move(half));
}

}  // namespace mapproof
