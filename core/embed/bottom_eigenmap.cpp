#include "core/embed/bottom_eigenmap.hpp"

#include <algorithm>

#include "core/linalg/symmetric_eigen.hpp"

namespace mapproof {
namespace {

/// Eigenvalues nearer to each other than this share of them, and of the matrix, count as one.
constexpr double kSame = 1e-9;
constexpr double kRounding = 1e-13;

}  // namespace

Embedding bottom_eigenmap(const Eigen::SparseMatrix<double>& matrix,
                          const Eigen::VectorXd& null_vector) {
  const Eigen::Index n = matrix.rows();
  const EigenPairs pairs =
      smallest_eigenpairs(matrix, std::min<Eigen::Index>(n - 1, 5), null_vector);
  Embedding result;
  result.coordinates = pairs.vectors.leftCols(2);
  result.spectrum = pairs.values;
  if (!pairs.converged)
    result.statuses.push_back(status_of<StatusReason::kEigenvaluesNotConverged>());
  const double size = matrix.diagonal().sum();
  if (n > 3 && pairs.values(2) - pairs.values(1) <= kSame * pairs.values(2) + kRounding * size)
    result.statuses.push_back(status_of<StatusReason::kEqualSmallestEigenvalues>(
        pairs.values(0), pairs.values(1), pairs.values(2)));
  return result;
}

}  // namespace mapproof
