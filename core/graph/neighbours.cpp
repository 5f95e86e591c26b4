#include "core/graph/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// 40 bits, some 12 significant digits: distances that differ by rounding alone become ties.
double rounded(double distance) {
  if (distance == 0.0 || !std::isfinite(distance)) return distance;
  int exponent = 0;
  const double mantissa = std::frexp(distance, &exponent);
  return std::ldexp(std::nearbyint(mantissa * 0x1p40), exponent - 40);
}

}  // namespace

Graph neighbour_graph(const Eigen::MatrixXd& distances, const NeighbourOptions& options) {
  const Eigen::Index n = distances.rows();
  if (options.neighbours < 1 || options.neighbours >= n)
    throw InvalidInput(
        fmt::format("K = {} nearest neighbours need 1 <= K < {} landmarks", options.neighbours, n));

  Eigen::Matrix<bool, Eigen::Dynamic, Eigen::Dynamic> joined;
  joined.setConstant(n, n, false);
  std::vector<std::pair<double, Eigen::Index>> order;
  for (Eigen::Index i = 0; i < n; ++i) {
    order.clear();
    for (Eigen::Index j = 0; j < n; ++j)
      if (j != i && distances(j, i) < options.cutoff && std::isfinite(distances(j, i)))
        order.emplace_back(rounded(distances(j, i)), j);
    const auto count = std::min<std::ptrdiff_t>(options.neighbours, std::ssize(order));
    std::partial_sort(order.begin(), order.begin() + count, order.end());
    for (std::ptrdiff_t rank = 0; rank < count; ++rank) {
      const Eigen::Index j = order[static_cast<std::size_t>(rank)].second;
      joined(i, j) = joined(j, i) = true;
    }
  }

  Graph graph(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      if (joined(j, i)) graph[static_cast<std::size_t>(i)].push_back({j, distances(j, i)});
  return graph;
}

}  // namespace mapproof
