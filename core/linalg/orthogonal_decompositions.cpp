#include "core/linalg/decompositions.hpp"

MAPPROOF_ORTHOGONAL_DECOMPOSITIONS(template)

namespace mapproof {

Eigen::MatrixXd leading_columns(
    const Eigen::HouseholderSequence<Eigen::MatrixXd, Eigen::VectorXd>& Q, Eigen::Index columns) {
  return Q * Eigen::MatrixXd::Identity(Q.rows(), columns);
}

}  // namespace mapproof
