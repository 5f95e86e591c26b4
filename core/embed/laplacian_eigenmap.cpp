#include "core/embed/laplacian_eigenmap.hpp"

#include <cmath>
#include <vector>

#include "core/base/errors.hpp"
#include "core/embed/bottom_eigenmap.hpp"

namespace mapproof {

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

}  // namespace mapproof
