#include "core/association/position_costs.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// Adds what an item costs if its landmark is at each point.
void add_costs(const Points& grid, const Eigen::RowVector2d& partner, const PairItem& item,
               double width_m, Eigen::Ref<Eigen::VectorXf> costs) {
  const Eigen::ArrayXd residuals =
      ((grid.rowwise() - partner).rowwise().norm().array() - item.distance_m).abs();
  costs.array() +=
      (item.weight * (residuals <= width_m)
                         .select(0.5 * residuals.square(), width_m * (residuals - 0.5 * width_m)))
          .cast<float>();
}

}  // namespace

Points grid_over(const Points& map, int side) {
  Eigen::RowVector2d low(HUGE_VAL, HUGE_VAL);
  Eigen::RowVector2d high = -low;
  for (Eigen::Index i = 0; i < map.rows(); ++i)
    if (map.row(i).allFinite()) {
      low = low.cwiseMin(map.row(i));
      high = high.cwiseMax(map.row(i));
    }
  Points grid = Points::Zero(static_cast<Eigen::Index>(side) * side, 2);
  if (!(low.array() <= high.array()).all()) return grid;
  const double margin = 0.25 * (high - low).maxCoeff();
  low.array() -= margin;
  high.array() += margin;
  for (int k = 0; k < side * side; ++k) {
    const int row = k / side;
    const Eigen::RowVector2d share(static_cast<double>(k % side) / (side - 1),
                                   static_cast<double>(row) / (side - 1));
    grid.row(k) = low.array() + share.array() * (high - low).array();
  }
  return grid;
}

PositionCosts position_costs(const std::vector<PairItem>& items, const RobustMap& map, int blocks,
                             const std::vector<int>& ids, int side) {
  if (side < 2) throw InvalidInput("a grid needs two points per side");
  PositionCosts result{grid_over(map.positions_m, side), {ids, {}, 0}};
  result.costs.segment = result.grid_m.rows();
  std::vector<int> position(static_cast<std::size_t>(map.positions_m.rows()), -1);
  for (std::size_t k = 0; k < ids.size(); ++k) {
    position[static_cast<std::size_t>(ids[k])] = static_cast<int>(k);
    result.costs.costs.emplace_back(Eigen::MatrixXf::Zero(result.grid_m.rows(), blocks));
  }
  for (const PairItem& item : items)
    for (const auto& [own, partner] :
         {std::pair(item.first, item.second), std::pair(item.second, item.first)}) {
      const int at = position[static_cast<std::size_t>(own)];
      if (at >= 0 && map.positions_m.row(partner).allFinite())
        add_costs(result.grid_m, map.positions_m.row(partner), item, map.width_m,
                  result.costs.costs[static_cast<std::size_t>(at)].col(item.block));
    }
  return result;
}

RobustMap unfolded_map(const std::vector<PairItem>& items, RobustMap map, int blocks) {
  for (int k = 0; k < map.positions_m.rows(); ++k) {
    if (!map.positions_m.row(k).allFinite()) continue;
    const PositionCosts positions = position_costs(items, map, blocks, {k});
    const Eigen::VectorXd costs = positions.costs.costs.front().cast<double>().rowwise().sum();
    Eigen::Index best = 0;
    const double least = costs.minCoeff(&best);
    // Another position on the coarse grid may be better than the present one only by much.
    double present = 0.0;
    for (const PairItem& item : items)
      if (item.first == k || item.second == k)
        present += map_cost({item}, map.positions_m, map.width_m);
    if (least >= present) continue;
    Points start = map.positions_m;
    start.row(k) = positions.grid_m.row(best);
    RobustMap other = minimized_map(items, start, map.width_m);
    if (other.cost < map.cost) map = std::move(other);
  }
  return map;
}

}  // namespace mapproof
