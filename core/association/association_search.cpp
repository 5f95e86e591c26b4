#include "core/association/association_search.hpp"

#include <algorithm>
#include <functional>

#include "core/association/position_costs.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostIds = 40;
constexpr int kMostPartners = 60;  ///< Of the search by distances: with more it would be slow.
constexpr int kDistances = 32;     ///< Values of a distance that are tried.

/// The best stretch of each fault of each pair of IDs, the best ones of all.
/// @param placed  Fills in where both landmarks are.
template <typename Placed>
std::vector<AssociationHypothesis> best_stretches(const StretchCosts& costs,
                                                  const LogBlocks& blocks, std::size_t most,
                                                  const Placed& placed) {
  std::vector<AssociationHypothesis> found;
  for (std::size_t order = 0; order < blocks.block_orders.size(); ++order) {
    StretchSearch search(costs, blocks.block_orders[order], static_cast<int>(order));
    const auto add_best = [&](AssociationFault fault, std::size_t a, std::size_t b) {
      AssociationHypothesis best = search.best(fault, a, b);
      if (!(best.gain > 0.0)) return;
      placed(best, search.costs(fault, a, b, best.begin, best.end));
      found.push_back(best);
    };
    for (std::size_t a = 0; a < costs.ids.size(); ++a)
      for (std::size_t b = 0; b < costs.ids.size(); ++b) {
        if (a < b) add_best(AssociationFault::kSwapped, a, b);
        if (a != b) add_best(AssociationFault::kWrong, a, b);
      }
  }
  std::ranges::stable_sort(found, std::greater<>(), &AssociationHypothesis::gain);
  if (found.size() > most) found.resize(most);
  return found;
}

/// What the items of each ID cost as a function of its distance to each partner.
StretchCosts distance_costs(const std::vector<PairItem>& items, const RobustMap& map,
                            const LogBlocks& blocks) {
  StretchCosts result{costly_ids(items, map, kMostIds), {}, kDistances};
  const Eigen::Index M = map.positions_m.rows();
  std::vector<int> position(static_cast<std::size_t>(M), -1);
  for (std::size_t k = 0; k < result.ids.size(); ++k)
    position[static_cast<std::size_t>(result.ids[k])] = static_cast<int>(k);
  result.costs.assign(result.ids.size(), Eigen::MatrixXf::Zero(M * kDistances, blocks.count));
  double longest = 0.0;
  for (const PairItem& item : items) longest = std::max(longest, item.distance_m);
  for (const PairItem& item : items)
    for (const auto& [own, partner] :
         {std::pair(item.first, item.second), std::pair(item.second, item.first)}) {
      const int at = position[static_cast<std::size_t>(own)];
      if (at < 0) continue;
      for (int k = 0; k < kDistances; ++k)
        result.costs[static_cast<std::size_t>(at)](partner * kDistances + k, item.block) +=
            static_cast<float>(
                item.weight *
                huber_cost(item.distance_m - longest * k / (kDistances - 1), map.width_m));
    }
  return result;
}

}  // namespace

std::vector<int> costly_ids(const std::vector<PairItem>& items, const RobustMap& map,
                            std::size_t most) {
  const Eigen::Index M = map.positions_m.rows();
  Eigen::VectorXd costs = Eigen::VectorXd::Zero(M);
  for (const PairItem& item : items) {
    const double cost = map_cost({item}, map.positions_m, map.width_m);
    costs(item.first) += cost;
    costs(item.second) += cost;
  }
  std::vector<int> ids;
  for (int k = 0; k < M; ++k)
    if (map.positions_m.row(k).allFinite()) ids.push_back(k);
  std::ranges::stable_sort(ids, std::greater<>(), [&](int k) { return costs(k); });
  ids.resize(std::min(ids.size(), most));
  std::ranges::sort(ids);
  return ids;
}

std::vector<AssociationHypothesis> hypotheses_in_map(const std::vector<PairItem>& items,
                                                     const RobustMap& map, const LogBlocks& blocks,
                                                     std::size_t most) {
  const PositionCosts positions =
      position_costs(items, map, blocks.count, costly_ids(items, map, kMostIds));
  return best_stretches(positions.costs, blocks, most,
                        [&](AssociationHypothesis& one, const auto& costs) {
                          Eigen::Index point = 0;
                          costs.first.minCoeff(&point);
                          one.first_m = positions.grid_m.row(point);
                          costs.second.minCoeff(&point);
                          one.second_m = positions.grid_m.row(point);
                        });
}

std::vector<AssociationHypothesis> hypotheses_of_distances(const std::vector<PairItem>& items,
                                                           const RobustMap& map,
                                                           const LogBlocks& blocks,
                                                           std::size_t most) {
  if (map.positions_m.rows() > kMostPartners) return {};
  return best_stretches(distance_costs(items, map, blocks), blocks, most,
                        [&](AssociationHypothesis& one, const auto&) {
                          one.first_m = map.positions_m.row(one.first);
                          one.second_m = map.positions_m.row(one.second);
                        });
}

}  // namespace mapproof
