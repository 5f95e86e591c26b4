#include "core/embed/lpca.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/linalg/centering.hpp"
#include "core/linalg/symmetric_eigen.hpp"

namespace mapproof {

Embedding lpca(const Eigen::MatrixXd& squared_distances) {
  const Eigen::Index n = squared_distances.rows();
  if (n < 3 || squared_distances.cols() != n)
    throw InvalidInput("LPCA needs a square matrix of at least 3 landmarks");

  const EigenPairs pairs =
      largest_eigenpairs(double_centered(squared_distances), std::min<Eigen::Index>(n, 10));
  Embedding result;
  result.spectrum = pairs.values;
  result.coordinates.setZero(n, 2);
  // Eigenvalues below rounding of the largest entry carry no direction.
  const double floor = 1e-12 * std::max(pairs.values(0), squared_distances.maxCoeff());
  int rank = 0;
  for (; rank < 2 && pairs.values(rank) > floor; ++rank)
    result.coordinates.col(rank) = std::sqrt(pairs.values(rank)) * pairs.vectors.col(rank);
  if (!pairs.converged)
    result.statuses.push_back(
        {StatusCode::kNotConverged, "The eigenvalues' solver gave up; these are its best."});
  if (rank < 2)
    result.statuses.push_back(
        {StatusCode::kRankDeficient,
         fmt::format("The observations spread in {} direction{}, a map needs two.", rank,
                     rank == 1 ? "" : "s")});
  return result;
}

}  // namespace mapproof
