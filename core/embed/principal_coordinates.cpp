#include "core/embed/principal_coordinates.hpp"

#include <algorithm>
#include <cmath>

#include "core/linalg/symmetric_eigen.hpp"

namespace mapproof {
namespace {

/// Eigenvalues up to this share of the largest, or of the matrix, are rounding.
constexpr double kCoordinateRounding = 1e-12;
/// Eigenvalues nearer to each other than this share of the largest count as one.
constexpr double kEqualEigenvalues = 1e-10;

}  // namespace

Embedding principal_coordinates(const Eigen::MatrixXd& B, double size) {
  const EigenPairs pairs = largest_eigenpairs(B, std::min<Eigen::Index>(B.rows(), 10));
  Embedding result;
  result.spectrum = pairs.values;
  result.coordinates.setZero(B.rows(), 2);
  const double floor = kCoordinateRounding * std::max(pairs.values(0), size);
  int rank = 0;
  for (; rank < 2 && pairs.values(rank) > floor; ++rank)
    result.coordinates.col(rank) = std::sqrt(pairs.values(rank)) * pairs.vectors.col(rank);
  if (!pairs.converged)
    result.statuses.push_back(status_of<StatusReason::kEigenvaluesNotConverged>());
  if (rank < 2) {
    result.statuses.push_back(status_of<StatusReason::kDistancesFlat>(rank));
  } else if (pairs.values(1) - pairs.values(2) <= kEqualEigenvalues * pairs.values(0)) {
    result.statuses.push_back(status_of<StatusReason::kEqualEigenvalues>(pairs.values(1)));
  }
  return result;
}

}  // namespace mapproof
