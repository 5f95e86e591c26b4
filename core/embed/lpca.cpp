#include "core/embed/lpca.hpp"

#include "core/base/errors.hpp"
#include "core/embed/principal_coordinates.hpp"
#include "core/linalg/centering.hpp"

namespace mapproof {

Embedding lpca(const Eigen::MatrixXd& squared_distances) {
  const Eigen::Index n = squared_distances.rows();
  if (n < 3 || squared_distances.cols() != n)
    throw InvalidInput("LPCA needs a square matrix of at least 3 landmarks");
  return principal_coordinates(double_centered(squared_distances), squared_distances.maxCoeff());
}

}  // namespace mapproof
