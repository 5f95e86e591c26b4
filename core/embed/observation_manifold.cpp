#include "core/embed/observation_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/graph/neighbours.hpp"
#include "core/linalg/centering.hpp"
#include "core/linalg/symmetric_eigen.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kDimensions = 3;
constexpr Eigen::Index kFewest = 4;

/// Rows left once those with the most unknown distances, one by one, are taken away.
std::vector<Eigen::Index> known_rows(const Eigen::MatrixXd& squared) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < squared.rows(); ++i) rows.push_back(i);
  while (!rows.empty()) {
    const auto unknown = [&](Eigen::Index i) {
      return std::ranges::count_if(rows,
                                   [&](Eigen::Index j) { return !std::isfinite(squared(i, j)); });
    };
    const auto worst = std::ranges::max_element(rows, {}, unknown);
    if (unknown(*worst) == 0) break;
    rows.erase(worst);
  }
  return rows;
}

}  // namespace

std::optional<ObservationManifold> observation_manifold(const Eigen::MatrixXd& squared_distances,
                                                        int neighbours) {
  const std::vector<Eigen::Index> rows = known_rows(squared_distances);
  const auto count = std::ssize(rows);
  if (count < kFewest) return std::nullopt;
  const Eigen::MatrixXd squared = squared_distances(rows, rows);
  const Eigen::MatrixXd B = double_centered(squared);
  const EigenPairs pairs = largest_eigenpairs(B, kDimensions);

  ObservationManifold found;
  found.coordinates.setConstant(squared_distances.rows(), kDimensions,
                                std::numeric_limits<double>::quiet_NaN());
  const double spread = B.trace();
  for (Eigen::Index k = 0; k < kDimensions; ++k) {
    const double value = std::max(pairs.values(k), 0.0);
    found.shares[static_cast<std::size_t>(k)] = spread > 0.0 ? value / spread : 0.0;
    for (Eigen::Index i = 0; i < count; ++i)
      found.coordinates(rows[static_cast<std::size_t>(i)], k) =
          std::sqrt(value) * pairs.vectors(i, k);
  }

  found.neighbours = static_cast<int>(std::min<Eigen::Index>(neighbours, count - 1));
  const Graph graph = neighbour_graph(squared.cwiseSqrt(), {.neighbours = found.neighbours});
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const Edge& edge : graph[i])
      if (static_cast<std::size_t>(edge.to) > i)
        found.edges.emplace_back(static_cast<int>(rows[i]),
                                 static_cast<int>(rows[static_cast<std::size_t>(edge.to)]));
  return found;
}

}  // namespace mapproof
