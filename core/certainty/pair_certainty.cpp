#include "core/certainty/pair_certainty.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/certainty/block_length.hpp"
#include "core/certainty/map_bootstrap.hpp"
#include "core/pairs/pair_map.hpp"

namespace mapproof {
namespace {

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

/// @param first  Of starts_of().
SightingLog drawn_log(const SightingLog& log, const std::vector<std::size_t>& first,
                      const std::vector<Eigen::Index>& looks) {
  SightingLog drawn{.names = log.names, .sightings = {}, .steps = 0, .times_s = {}};
  drawn.sightings.reserve(log.sightings.size());
  for (const Eigen::Index look : looks) {
    const auto at = static_cast<std::size_t>(look);
    for (std::size_t i = first[at]; i < first[at + 1]; ++i) {
      drawn.sightings.push_back(log.sightings[i]);
      drawn.sightings.back().step = drawn.steps;
    }
    ++drawn.steps;
  }
  return drawn;
}

/// +1 where a look measured more than the pair's median, -1 less, 0 not at all.
Eigen::VectorXd signs_of(const SightingLog& log, const std::vector<std::size_t>& first,
                         const MeasuredPair& pair) {
  Eigen::VectorXd signs = Eigen::VectorXd::Zero(log.steps);
  for (Eigen::Index look = 0; look < log.steps; ++look) {
    const Sighting* a = nullptr;
    const Sighting* b = nullptr;
    for (std::size_t i = first[static_cast<std::size_t>(look)];
         i < first[static_cast<std::size_t>(look) + 1]; ++i) {
      if (log.sightings[i].landmark == pair.first) a = &log.sightings[i];
      if (log.sightings[i].landmark == pair.second) b = &log.sightings[i];
    }
    if (a == nullptr || b == nullptr) continue;
    const double over = look_distance(*a, *b) - pair.distance_m;
    if (over != 0.0 && !std::isnan(over)) signs(look) = over > 0.0 ? 1.0 : -1.0;
  }
  return signs;
}

Eigen::Index block_length_of(const SightingLog& log, std::vector<MeasuredPair> pairs) {
  std::ranges::stable_sort(pairs, std::ranges::greater(), &MeasuredPair::looks);
  // The pairs seen most often tell enough; a length costs some N^1.5 for N looks.
  constexpr double kMostPairs = 60.0;
  constexpr double kMostWork = 3e8;
  const double most =
      std::clamp(kMostWork / std::pow(std::max(1, log.steps), 1.5), 1.0, kMostPairs);
  pairs.resize(std::min(pairs.size(), static_cast<std::size_t>(most)));
  const std::vector<std::size_t> first = starts_of(log);
  double sum = 0.0;
  for (const MeasuredPair& pair : pairs) sum += best_block_length(signs_of(log, first, pair));
  const double mean = pairs.empty() ? 1.0 : sum / static_cast<double>(pairs.size());
  return std::clamp<Eigen::Index>(std::llround(mean), 1, std::max(1, (log.steps + 2) / 3));
}

}  // namespace

Eigen::Index pair_block_length(const SightingLog& log) {
  return block_length_of(log, measured_pairs(log));
}

MapCertainty pair_certainty(const SightingLog& log, const CertaintyFrame& frame,
                            const PairCertaintyOptions& options) {
  if (log.steps < 1) throw InvalidInput("a bootstrap needs a look or more");
  if (frame.positions_m.rows() != std::ssize(log.names))
    throw InvalidInput("a certainty needs a frame of all landmarks");
  std::set<std::pair<Eigen::Index, Eigen::Index>> trusted;
  const PairMap whole = sighted_map(log);
  const std::vector<MeasuredPair>& pairs = whole.pairs;
  for (const MeasuredPair& pair : pairs) trusted.emplace(pair.first, pair.second);
  const Eigen::Index block = options.block > 0 ? options.block : block_length_of(log, pairs);
  const std::vector<std::size_t> first = starts_of(log);
  PairMapOptions drawing{.fewest_looks = 1};
  drawing.start = whole.embedding.coordinates;
  const auto map_of = [&](const std::vector<Eigen::Index>& looks) {
    std::vector<MeasuredPair> drawn = measured_pairs(drawn_log(log, first, looks));
    std::erase_if(drawn, [&](const MeasuredPair& pair) {
      return !trusted.contains({pair.first, pair.second});
    });
    const PairMap map = pair_map(drawn, log.names, drawing);
    return in_frame(map.embedding.coordinates, frame, options.fit);
  };
  return bootstrap_map(std::ssize(log.names), log.steps, map_of,
                       {.replicates = options.replicates, .block = block, .seed = options.seed});
}

}  // namespace mapproof
