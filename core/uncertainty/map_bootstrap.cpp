#include "core/uncertainty/map_bootstrap.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/statistics/block_bootstrap.hpp"

namespace mapproof {
namespace {

/// Covariance of a landmark's positions in the maps that have it; NaN if fewer than half of them
/// do.
Eigen::Matrix2d covariance(const std::vector<Points>& maps, Eigen::Index landmark) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (const Points& map : maps)
    if (map.row(landmark).allFinite()) {
      sum += map.row(landmark).transpose();
      ++count;
    }
  if (count < 3 || 2 * count < static_cast<int>(maps.size()))
    return Eigen::Matrix2d::Constant(kNaN);
  const Eigen::Vector2d mean = sum / count;
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
  for (const Points& map : maps) {
    if (!map.row(landmark).allFinite()) continue;
    const Eigen::Vector2d offset = map.row(landmark).transpose() - mean;
    squares += offset * offset.transpose();
  }
  return squares / (count - 1);
}

}  // namespace

MapUncertainty bootstrap_map(Eigen::Index landmarks, Eigen::Index steps, const MapOfSteps& map_of,
                             const MapBootstrapOptions& options) {
  if (options.replicates < 10 || options.replicates > 10000)
    throw InvalidInput("the bootstrap needs 10 to 10,000 replicates");
  std::vector<Points> maps;
  for (int i = 0; i < options.replicates; ++i) {
    Random random(derive_seed(options.seed, {static_cast<std::uint64_t>(i)}));
    std::optional<Points> map =
        map_of(block_resample(steps, options.block, BlockEnds::kCircular, random));
    if (!map) continue;
    if (map->rows() != landmarks) throw InvalidInput("a bootstrap's maps need all landmarks");
    maps.push_back(std::move(*map));
  }
  MapUncertainty result;
  result.replicates = options.replicates;
  result.maps = static_cast<int>(maps.size());
  result.block_steps = static_cast<int>(options.block);
  for (Eigen::Index i = 0; i < landmarks; ++i) result.covariances.push_back(covariance(maps, i));
  result.squared_radius =
      squared_radius(result.confidence, bootstrap_freedom(steps, options.block, result.maps));
  return result;
}

double bootstrap_freedom(Eigen::Index steps, Eigen::Index block, int maps) {
  const double of_blocks = 1.5 * static_cast<double>(steps) / static_cast<double>(block);
  const double of_maps = std::max(2.0, static_cast<double>(maps) - 1.0);
  return std::max(1.5, 1.0 / (1.0 / of_blocks + 1.0 / of_maps));
}

double squared_radius(double confidence, double freedom) {
  if (!(confidence > 0.0 && confidence < 1.0))
    throw InvalidInput("a confidence must lie between 0 and 1");
  if (!(freedom > 1.0)) throw InvalidInput("an ellipse needs more than one degree of freedom");
  // 2 f / (f - 1) times the quantile of F with 2 and f - 1 degrees, which has a closed form.
  return freedom * std::expm1(-2.0 / (freedom - 1.0) * std::log1p(-confidence));
}

}  // namespace mapproof
