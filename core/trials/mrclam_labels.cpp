#include "core/trials/mrclam_labels.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/random.hpp"
#include "core/labels/anchor_labels.hpp"
#include "core/labels/mislabelled.hpp"
#include "core/labels/shared_label.hpp"

namespace mapproof {
namespace {

/// Landmarks, those of most sightings first.
std::vector<int> by_sightings(const SightingLog& log) {
  std::vector<int> count(log.names.size(), 0);
  for (const Sighting& seen : log.sightings) ++count[static_cast<std::size_t>(seen.landmark)];
  std::vector<int> order(log.names.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater(),
                           [&](int k) { return count[static_cast<std::size_t>(k)]; });
  return order;
}

SightingLog swapped_in_half(SightingLog log, int a, int b, std::uint64_t seed) {
  Random random(seed);
  std::vector<bool> is_wrong;
  for (int look = 0; look < log.steps; ++look) is_wrong.push_back(random.uniform() < 0.5);
  for (Sighting& seen : log.sightings)
    if (is_wrong[static_cast<std::size_t>(seen.step)] && (seen.landmark == a || seen.landmark == b))
      seen.landmark = seen.landmark == a ? b : a;
  sort_sightings(log.sightings);
  return log;
}

/// @param log  Where both are in a look, the misnamed sighting is left out: a label is there once.
SightingLog misnamed(SightingLog log, int a, int b) {
  std::set<int> of_b;
  for (const Sighting& seen : log.sightings)
    if (seen.landmark == b) of_b.insert(seen.step);
  std::erase_if(log.sightings, [&](const Sighting& seen) {
    return seen.landmark == a && of_b.contains(seen.step);
  });
  for (Sighting& seen : log.sightings)
    if (seen.landmark == a) seen.landmark = b;
  sort_sightings(log.sightings);
  return log;
}

}  // namespace

std::vector<SpoiltLabels> spoilt_labels(const SightingLog& log, std::uint64_t seed) {
  const std::vector<int> order = by_sightings(log);
  if (order.size() < 6) return {};
  return {{"swapped", swapped_in_half(log, order[1], order[4], seed)},
          {"misnamed", misnamed(log, order[5], order[2])}};
}

MendedLabels mended_log(const SightingLog& log, const std::optional<Points>& known_m) {
  MendedLabels mended{.faults = 0, .log = log};
  const std::vector<Eigen::Index> unseen = unseen_in(log);
  if (unseen.size() == 1)
    if (const auto shared = shared_label(log)) {
      ++mended.faults;
      mended.log = split_label(log, *shared, static_cast<int>(unseen.front()));
    }
  LabelCheck check = check_labels(mended.log);
  mended.faults += static_cast<int>(check.findings.size());
  mended.log = std::move(check.repaired);
  if (!known_m) return mended;
  AnchorCheck places = check_anchor_labels(mended.log, *known_m);
  mended.faults += static_cast<int>(places.exchanges.size());
  mended.log = std::move(places.repaired);
  return mended;
}

}  // namespace mapproof
