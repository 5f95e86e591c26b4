#include "core/submaps/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/linalg/planarity.hpp"

namespace mapproof {
namespace {

/// Shared landmarks flatter than this leave the mirror image to chance.
constexpr double kFlattest = 0.05;

std::vector<std::pair<Eigen::Index, Eigen::Index>> shared_rows(const Submap& first,
                                                               const Submap& second) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> rows;
  std::size_t j = 0;
  for (std::size_t i = 0; i < first.landmarks.size(); ++i) {
    while (j < second.landmarks.size() && second.landmarks[j] < first.landmarks[i]) ++j;
    if (j < second.landmarks.size() && second.landmarks[j] == first.landmarks[i])
      rows.emplace_back(i, j);
  }
  return rows;
}

}  // namespace

std::vector<Overlap> overlaps_of(const std::vector<Submap>& maps, JoinKind kind) {
  std::vector<Overlap> overlaps;
  for (std::size_t g = 0; g < maps.size(); ++g)
    for (std::size_t h = g + 1; h < maps.size(); ++h) {
      Overlap overlap{.first = static_cast<int>(g),
                      .second = static_cast<int>(h),
                      .shared = shared_rows(maps[g], maps[h]),
                      .to_first = {},
                      .to_second = {}};
      const auto n = static_cast<Eigen::Index>(overlap.shared.size());
      if (n < 3) continue;
      Points in_first(n, 2), in_second(n, 2);
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto& [i, j] = overlap.shared[static_cast<std::size_t>(k)];
        in_first.row(k) = maps[g].positions.row(i);
        in_second.row(k) = maps[h].positions.row(j);
      }
      if (planarity(in_first) < kFlattest || planarity(in_second) < kFlattest) continue;
      double there = 0.0, back = 0.0;
      overlap.to_first = fit_join_robustly(in_second, in_first, kind, there);
      overlap.to_second = fit_join_robustly(in_first, in_second, kind, back);
      overlap.residual = (there + back) / 2.0;
      overlap.cost = overlap.residual / std::sqrt(static_cast<double>(n));
      overlaps.push_back(std::move(overlap));
    }
  return overlaps;
}

std::vector<std::size_t> spanning_tree(const std::vector<Overlap>& overlaps, std::size_t maps) {
  std::vector<std::size_t> order(overlaps.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return overlaps[k].cost; });
  std::vector<int> piece(maps);
  std::iota(piece.begin(), piece.end(), 0);
  std::vector<std::size_t> tree;
  for (const std::size_t k : order) {
    const int kept = piece[static_cast<std::size_t>(overlaps[k].first)];
    const int joined = piece[static_cast<std::size_t>(overlaps[k].second)];
    if (kept == joined) continue;
    std::ranges::replace(piece, joined, kept);
    tree.push_back(k);
  }
  std::ranges::sort(tree);
  return tree;
}

}  // namespace mapproof
