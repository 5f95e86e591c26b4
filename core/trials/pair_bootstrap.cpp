#include "core/trials/pair_bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/score/map_score.hpp"

namespace mapproof {
namespace {

/// Looks of blocks drawn from a circle, as many as there are.
SightingLog drawn_log(const SightingLog& log, const std::vector<std::size_t>& first, int block,
                      Random& random) {
  SightingLog drawn{.names = log.names, .sightings = {}, .steps = 0, .times_s = {}};
  drawn.sightings.reserve(log.sightings.size());
  while (drawn.steps < log.steps) {
    const int start = static_cast<int>(random.uniform() * log.steps);
    for (int k = 0; k < block && drawn.steps < log.steps; ++k, ++drawn.steps) {
      const auto look = static_cast<std::size_t>((start + k) % log.steps);
      for (std::size_t i = first[look]; i < first[look + 1]; ++i) {
        drawn.sightings.push_back(log.sightings[i]);
        drawn.sightings.back().step = drawn.steps;
      }
    }
  }
  return drawn;
}

/// Where the sightings of each look begin, and the end of the last.
std::vector<std::size_t> starts_of(const SightingLog& log) {
  std::vector<std::size_t> first;
  std::size_t i = 0;
  for (int look = 0; look <= log.steps; ++look) {
    while (i < log.sightings.size() && log.sightings[i].step < look) ++i;
    first.push_back(i);
  }
  return first;
}

std::optional<Points> in_frame(const Points& map, const PairBootstrapOptions& options) {
  if (!options.anchors.empty()) {
    AlignedMap aligned =
        align_to_anchors(map, options.positions_m, options.anchors, AffineFit::kLeastDistances);
    if (!aligned.aligned) return std::nullopt;
    return std::move(aligned.positions_m);
  }
  std::vector<Eigen::Index> both;
  for (Eigen::Index i = 0; i < map.rows(); ++i)
    if (map.row(i).allFinite() && options.positions_m.row(i).allFinite()) both.push_back(i);
  if (both.size() < 3) return std::nullopt;
  return fit_similarity(map(both, Eigen::all), options.positions_m(both, Eigen::all),
                        Alignment::kRigidWithReflection)(map);
}

Eigen::Matrix2d covariance(const std::vector<Points>& maps, Eigen::Index landmark, int replicates) {
  std::vector<Eigen::RowVector2d> places;
  for (const Points& map : maps)
    if (map.row(landmark).allFinite()) places.emplace_back(map.row(landmark));
  if (std::ssize(places) < 3 || 2 * std::ssize(places) < replicates)
    return Eigen::Matrix2d::Constant(std::numeric_limits<double>::quiet_NaN());
  Eigen::RowVector2d mean = Eigen::RowVector2d::Zero();
  for (const Eigen::RowVector2d& place : places) mean += place;
  mean /= static_cast<double>(places.size());
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  for (const Eigen::RowVector2d& place : places) sum += (place - mean).transpose() * (place - mean);
  return sum / static_cast<double>(places.size() - 1);
}

}  // namespace

std::vector<Eigen::Matrix2d> pair_covariances(const SightingLog& log,
                                              const PairBootstrapOptions& options) {
  if (options.replicates < 1 || options.block_looks < 1 || log.steps < 1)
    throw InvalidInput("a bootstrap needs a look, a replicate and a look a block, or more");
  const std::vector<std::size_t> first = starts_of(log);
  // Which pairs are trusted is of the looks as they are: drawn twice, a wrong one would pass.
  std::set<std::pair<Eigen::Index, Eigen::Index>> trusted;
  for (const MeasuredPair& pair : sighted_map(log).pairs) trusted.emplace(pair.first, pair.second);
  const PairMapOptions all{.fewest_looks = 1};
  std::vector<Points> maps;
  for (int replicate = 0; replicate < options.replicates; ++replicate) {
    Random random(derive_seed(options.seed, {static_cast<std::uint64_t>(replicate)}));
    std::vector<MeasuredPair> pairs =
        measured_pairs(drawn_log(log, first, options.block_looks, random));
    std::erase_if(pairs, [&](const MeasuredPair& pair) {
      return !trusted.contains({pair.first, pair.second});
    });
    const PairMap map = pair_map(pairs, log.names, all);
    if (auto placed = in_frame(map.embedding.coordinates, options)) maps.push_back(*placed);
  }
  std::vector<Eigen::Matrix2d> covariances;
  for (std::size_t i = 0; i < log.names.size(); ++i)
    covariances.push_back(covariance(maps, static_cast<Eigen::Index>(i), options.replicates));
  return covariances;
}

}  // namespace mapproof
