#include "core/embed/bottom_eigenmap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/errors.hpp"
#include "core/linalg/symmetric_eigen.hpp"

namespace mapproof {
namespace {

/// Eigenvalues nearer to each other than this share of them, and of the matrix, count as one.
constexpr double kSame = 1e-9;
constexpr double kRounding = 1e-13;

}  // namespace

Embedding laplacian_eigenmap(const Graph& graph) {
  const Eigen::Index n = std::ssize(graph);
  if (n < 3) throw InvalidInput("a Laplacian eigenmap needs at least 3 landmarks");
  Eigen::VectorXd root_degree(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::vector<Edge>& edges = graph[static_cast<std::size_t>(i)];
    if (edges.empty()) throw InvalidInput("a Laplacian eigenmap needs an edge at each landmark");
    root_degree(i) = std::sqrt(static_cast<double>(edges.size()));
  }

  // u = D^1/2 v turns the problem into that of I - D^-1/2 A D^-1/2, whose null vector is D^1/2 1.
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 1.0);
    for (const Edge& edge : graph[static_cast<std::size_t>(i)])
      entries.emplace_back(i, edge.to, -1.0 / (root_degree(i) * root_degree(edge.to)));
  }
  Eigen::SparseMatrix<double> L(n, n);
  L.setFromTriplets(entries.begin(), entries.end());
  Embedding result = bottom_eigenmap(L, root_degree.normalized());
  result.coordinates.array().colwise() /= root_degree.array();
  return result;
}

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
