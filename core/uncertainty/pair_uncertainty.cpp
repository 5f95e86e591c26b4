#include "core/uncertainty/pair_uncertainty.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/uncertainty/block_length.hpp"
#include "core/uncertainty/map_bootstrap.hpp"

namespace mapproof {
namespace {

/// Where the detections of each scan begin, and the end of the last.
std::vector<std::size_t> starts_of(const DetectionLog& log) {
  std::vector<std::size_t> first;
  std::size_t i = 0;
  for (int scan = 0; scan <= log.steps; ++scan) {
    while (i < log.detections.size() && log.detections[i].step < scan) ++i;
    first.push_back(i);
  }
  return first;
}

/// @param first  Of starts_of().
DetectionLog drawn_log(const DetectionLog& log, const std::vector<std::size_t>& first,
                       const std::vector<Eigen::Index>& scans) {
  DetectionLog drawn{.names = log.names, .detections = {}, .steps = 0, .times_s = {}};
  drawn.detections.reserve(log.detections.size());
  for (const Eigen::Index scan : scans) {
    const auto at = static_cast<std::size_t>(scan);
    for (std::size_t i = first[at]; i < first[at + 1]; ++i) {
      drawn.detections.push_back(log.detections[i]);
      drawn.detections.back().step = drawn.steps;
    }
    ++drawn.steps;
  }
  return drawn;
}

/// +1 where a scan measured more than the pair's median, -1 less, 0 not at all.
Eigen::VectorXd signs_of(const DetectionLog& log, const std::vector<std::size_t>& first,
                         const MeasuredPair& pair) {
  Eigen::VectorXd signs = Eigen::VectorXd::Zero(log.steps);
  for (Eigen::Index scan = 0; scan < log.steps; ++scan) {
    const Detection* a = nullptr;
    const Detection* b = nullptr;
    for (std::size_t i = first[static_cast<std::size_t>(scan)];
         i < first[static_cast<std::size_t>(scan) + 1]; ++i) {
      if (log.detections[i].landmark == pair.first) a = &log.detections[i];
      if (log.detections[i].landmark == pair.second) b = &log.detections[i];
    }
    if (a == nullptr || b == nullptr) continue;
    const double over = scan_distance(*a, *b) - pair.distance_m;
    if (over != 0.0 && !std::isnan(over)) signs(scan) = over > 0.0 ? 1.0 : -1.0;
  }
  return signs;
}

Eigen::Index block_length_of(const DetectionLog& log, std::vector<MeasuredPair> pairs) {
  std::ranges::stable_sort(pairs, std::ranges::greater(), &MeasuredPair::scans);
  // The pairs seen most often suffice; a length costs some N^1.5 for N scans.
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

Eigen::Index pair_block_length(const DetectionLog& log) {
  return block_length_of(log, measured_pairs(log));
}

MapUncertainty pair_uncertainty(const DetectionLog& log, const UncertaintyFrame& frame,
                                const PairUncertaintyOptions& options) {
  if (log.steps < 1) throw InvalidInput("a bootstrap needs a scan or more");
  if (frame.positions_m.rows() != std::ssize(log.names))
    throw InvalidInput("confidence ellipses need a frame of all landmarks");
  std::set<std::pair<Eigen::Index, Eigen::Index>> trusted;
  const PairMap whole = pair_map_of(log);
  const std::vector<MeasuredPair>& pairs = whole.pairs;
  for (const MeasuredPair& pair : pairs) trusted.emplace(pair.first, pair.second);
  const Eigen::Index block = options.block > 0 ? options.block : block_length_of(log, pairs);
  const std::vector<std::size_t> first = starts_of(log);
  PairMapOptions drawing{.fewest_scans = 1};
  drawing.start = whole.embedding.coordinates;
  const auto map_of = [&](const std::vector<Eigen::Index>& scans) {
    std::vector<MeasuredPair> drawn = measured_pairs(drawn_log(log, first, scans));
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
