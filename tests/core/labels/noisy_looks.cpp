#include "noisy_looks.hpp"

#include <algorithm>
#include <set>
#include <tuple>

#include "core/base/random.hpp"
#include "tests/support/looks.hpp"
#include "tests/support/worlds.hpp"

namespace mapproof::test {
namespace {

std::tuple<int, int> key(const Sighting& one) { return {one.step, one.landmark}; }

}  // namespace

Points noisy_landmarks() {
  Points places = 2.0 * grid(5, 3);
  Random random(3);
  for (Eigen::Index i = 0; i < places.rows(); ++i)
    places.row(i) += Eigen::RowVector2d(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4));
  return places;
}

SightingLog noisy_looks(int looks, std::uint64_t seed) {
  SightingLog log = looks_at(noisy_landmarks(), looks, 4, seed);
  Random random(seed + 1);
  for (Sighting& sighting : log.sightings) {
    sighting.range_m *= 1.0 + 0.03 * random.normal();
    sighting.bearing_rad += 0.0175 * random.normal();
  }
  return log;
}

SightingLog looks_with_move(int looks, int landmark, const Eigen::RowVector2d& by_m, int from) {
  Points places = noisy_landmarks();
  SightingLog log = looks_at(places, looks, 5, 11);
  places.row(landmark) += by_m;
  const SightingLog later = looks_at(places, looks, 5, 11);
  std::erase_if(log.sightings, [&](const Sighting& one) { return one.step >= from; });
  for (const Sighting& one : later.sightings)
    if (one.step >= from) log.sightings.push_back(one);
  Random random(5);
  for (Sighting& one : log.sightings) {
    one.range_m *= 1.0 + 0.02 * random.normal();
    one.bearing_rad += 0.0175 * random.normal();
  }
  return log;
}

SightingLog swapped(SightingLog log, int first, int second,
                    const std::function<bool(int)>& in_step) {
  for (Sighting& sighting : log.sightings) {
    if (!in_step(sighting.step)) continue;
    if (sighting.landmark == first)
      sighting.landmark = second;
    else if (sighting.landmark == second)
      sighting.landmark = first;
  }
  std::ranges::stable_sort(log.sightings, {}, key);
  return log;
}

SightingLog called(SightingLog log, int landmark, int other,
                   const std::function<bool(int)>& in_step) {
  std::set<int> taken;
  for (const Sighting& sighting : log.sightings)
    if (sighting.landmark == other) taken.insert(sighting.step);
  for (Sighting& sighting : log.sightings)
    if (sighting.landmark == landmark && in_step(sighting.step) && !taken.contains(sighting.step))
      sighting.landmark = other;
  std::ranges::stable_sort(log.sightings, {}, key);
  return log;
}

int wrong_labels(const SightingLog& log, const SightingLog& truth) {
  std::set<std::tuple<int, int>> right;
  for (const Sighting& sighting : truth.sightings) right.insert(key(sighting));
  return static_cast<int>(std::ranges::count_if(
      log.sightings, [&](const Sighting& sighting) { return !right.contains(key(sighting)); }));
}

}  // namespace mapproof::test
