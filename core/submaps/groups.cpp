#include "core/submaps/groups.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/errors.hpp"
#include "core/graph/components.hpp"
#include "core/graph/shortest_paths.hpp"

namespace mapproof {
namespace {

using Rows = std::vector<Eigen::Index>;

/// Along the neighbour graph; pieces of it are further apart than anything within them.
Eigen::MatrixXd paths_of(const Eigen::MatrixXd& distances, int neighbours) {
  const auto K = static_cast<int>(std::min<Eigen::Index>(neighbours, distances.rows() - 1));
  Graph graph = neighbour_graph(distances, {.neighbours = K});
  bridge_components(graph, distances);
  Eigen::MatrixXd paths = shortest_paths(graph);
  double longest = 0.0;
  for (const double path : paths.reshaped())
    if (std::isfinite(path)) longest = std::max(longest, path);
  return paths.array().isFinite().select(paths, 2.0 * longest + 1.0);
}

Eigen::Index furthest_from(const Eigen::MatrixXd& paths, Eigen::Index from, const Rows& among) {
  return *std::ranges::max_element(
      among, [&](Eigen::Index a, Eigen::Index b) { return paths(a, from) < paths(b, from); });
}

/// Splits `rows` into `parts` of like size.
void divide(const Eigen::MatrixXd& paths, Rows rows, std::size_t parts, std::vector<Rows>& out) {
  if (parts <= 1) {
    std::ranges::sort(rows);
    out.push_back(std::move(rows));
    return;
  }
  const Eigen::Index a = furthest_from(paths, rows.front(), rows);
  const Eigen::Index b = furthest_from(paths, a, rows);
  const auto side = [&](Eigen::Index i) { return paths(i, a) - paths(i, b); };
  std::ranges::sort(rows, [&](Eigen::Index i, Eigen::Index j) {
    return side(i) < side(j) || (side(i) == side(j) && i < j);
  });
  const std::size_t first_parts = parts / 2;
  const auto cut = static_cast<std::ptrdiff_t>(rows.size() * first_parts / parts);
  divide(paths, Rows(rows.begin(), rows.begin() + cut), first_parts, out);
  divide(paths, Rows(rows.begin() + cut, rows.end()), parts - first_parts, out);
}

/// `own` and the nearest others, `size` in all.
Rows grown(const Eigen::MatrixXd& paths, const Rows& own, std::size_t size) {
  const Eigen::VectorXd nearness = paths(Eigen::all, own).rowwise().minCoeff();
  Rows order(static_cast<std::size_t>(paths.rows()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](Eigen::Index i, Eigen::Index j) {
    const bool i_own = std::ranges::binary_search(own, i);
    const bool j_own = std::ranges::binary_search(own, j);
    if (i_own != j_own) return i_own;
    return nearness(i) < nearness(j) || (nearness(i) == nearness(j) && i < j);
  });
  order.resize(std::min(size, order.size()));
  std::ranges::sort(order);
  return order;
}

}  // namespace

std::vector<LandmarkGroup> overlapping_groups(const Eigen::MatrixXd& distances,
                                              const GroupOptions& options) {
  if (options.size < 6 || options.neighbours < 1 ||
      !(options.overlap_share >= 0.0 && options.overlap_share <= 0.8))
    throw InvalidInput("groups of 6 landmarks or more that share 0 to 80 % of them can be made");
  const Eigen::Index M = distances.rows();
  Rows all(static_cast<std::size_t>(M));
  std::iota(all.begin(), all.end(), 0);
  if (M <= options.size) return {{.own = all, .members = all}};
  const Eigen::MatrixXd paths = paths_of(distances, options.neighbours);
  const double part_size = std::max(1.0, std::floor(options.size * (1.0 - options.overlap_share)));
  const auto parts = static_cast<std::size_t>(std::ceil(static_cast<double>(M) / part_size));
  std::vector<Rows> owned;
  divide(paths, all, parts, owned);
  std::vector<LandmarkGroup> groups;
  for (const Rows& own : owned)
    groups.push_back(
        {.own = own, .members = grown(paths, own, static_cast<std::size_t>(options.size))});
  return groups;
}

}  // namespace mapproof
