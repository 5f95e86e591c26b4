#include "core/embed/local_gram.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {

void check_neighbourhoods(const Eigen::MatrixXd& squared_distances,
                          const NeighbourLists& neighbours, int fewest) {
  const Eigen::Index n = squared_distances.rows();
  if (n < 3 || squared_distances.cols() != n || std::ssize(neighbours) != n)
    throw InvalidInput("need a square matrix of at least 3 landmarks, and neighbours of each");
  if (!squared_distances.allFinite()) throw InvalidInput("need finite distances");
  for (const std::vector<Edge>& edges : neighbours) {
    if (std::ssize(edges) < fewest)
      throw InvalidInput(fmt::format("need {} neighbours of each landmark", fewest));
    for (const Edge& edge : edges)
      if (edge.to < 0 || edge.to >= n) throw InvalidInput("a neighbour that is not a landmark");
  }
}

void gram_about(const Eigen::MatrixXd& squared_distances, Eigen::Index i,
                const std::vector<Edge>& edges, Eigen::MatrixXd& gram) {
  const Eigen::Index k = std::ssize(edges);
  gram.resize(k, k);
  for (Eigen::Index b = 0; b < k; ++b) {
    const Eigen::Index to = edges[static_cast<std::size_t>(b)].to;
    for (Eigen::Index a = b; a < k; ++a) {
      const Eigen::Index from = edges[static_cast<std::size_t>(a)].to;
      gram(a, b) = gram(b, a) = 0.5 * (squared_distances(from, i) + squared_distances(to, i) -
                                       squared_distances(from, to));
    }
  }
}

void QuadraticForms::add(const std::vector<Eigen::Index>& support,
                         const Eigen::MatrixXd& coefficients) {
  for (Eigen::Index b = 0; b < coefficients.rows(); ++b)
    for (Eigen::Index a = 0; a < coefficients.rows(); ++a)
      entries_.emplace_back(support[static_cast<std::size_t>(a)],
                            support[static_cast<std::size_t>(b)],
                            coefficients.row(a).dot(coefficients.row(b)));
}

Eigen::SparseMatrix<double> QuadraticForms::matrix() const {
  Eigen::SparseMatrix<double> matrix(n_, n_);
  matrix.setFromTriplets(entries_.begin(), entries_.end());
  return matrix;
}

}  // namespace mapproof
