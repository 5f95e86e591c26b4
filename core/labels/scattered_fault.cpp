#include "core/labels/scattered_fault.hpp"

#include <algorithm>

#include "core/labels/look_by_look.hpp"
#include "core/labels/place_costs.hpp"
#include "core/labels/two_places.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kTried = 4;  ///< Twos of labels that are settled.
/// So rare, and so much rarer than the other label's, one label's changes are chance.
constexpr double kByChance = 0.1;
constexpr double kRarer = 0.25;

/// Sightings that a trial gives another label, of each of both.
struct Changes {
  double all = 0.0;
  double first_share = 0.0;  ///< Of those under the first label.
  double second_share = 0.0;

  bool one_sided() const {
    const auto [less, more] = std::minmax(first_share, second_share);
    return less < kByChance && less < kRarer * more;
  }
};

Changes changes_of(const std::vector<int>& labels, const FaultTrial& trial) {
  double first = 0.0;
  double second = 0.0;
  double of_first = 1.0;
  double of_second = 1.0;
  for (std::size_t k = 0; k < labels.size(); ++k) {
    const double changed = labels[k] != trial.labels[k] ? 1.0 : 0.0;
    if (labels[k] == trial.fault.first) {
      of_first += 1.0;
      first += changed;
    } else if (labels[k] == trial.fault.second) {
      of_second += 1.0;
      second += changed;
    }
  }
  return {first + second, first / of_first, second / of_second};
}

FaultTrial settled(const LabelledLooks& looks, const std::vector<int>& labels,
                   const SharedPlaces& shared, const Points& start, LabelFault fault, bool turned,
                   double width_m) {
  FaultTrial trial;
  trial.fault.fault = fault;
  trial.fault.first = turned ? shared.second : shared.first;
  trial.fault.second = turned ? shared.first : shared.second;
  trial.stretch = {0, 0, looks.places.front().size()};
  trial.scattered = true;
  return settled_trial(looks, labels, labels, std::move(trial), start, shared.map.width_m, width_m);
}

/// Both ways of telling whose the places are; of them the simpler one.
FaultTrial simpler_trial(const LabelledLooks& looks, const std::vector<int>& labels,
                         const SharedPlaces& shared, double width_m) {
  const Points& start = shared.map.positions_m;
  Points exchanged = start;
  exchanged.row(shared.first).swap(exchanged.row(shared.second));
  FaultTrial best = settled(looks, labels, shared, start, LabelFault::kSwapped, false, width_m);
  FaultTrial other = settled(looks, labels, shared, exchanged, LabelFault::kSwapped, false, width_m);
  Changes changes = changes_of(labels, best);
  const Changes of_other = changes_of(labels, other);
  if (changes.one_sided() != of_other.one_sided() ? of_other.one_sided()
                                                  : of_other.all < changes.all) {
    best = std::move(other);
    changes = of_other;
  }
  if (!changes.one_sided()) return best;
  const Points places = best.map.positions_m;
  return settled(looks, labels, shared, places, LabelFault::kMixed,
                 changes.second_share > changes.first_share, width_m);
}

}  // namespace

std::optional<FaultTrial> scattered_trial(const LabelledLooks& looks,
                                          const std::vector<int>& labels, const RobustMap& map) {
  std::optional<FaultTrial> best;
  for (const SharedPlaces& shared : shared_places(looks, labels, map, kTried)) {
    FaultTrial trial = simpler_trial(looks, labels, shared, map.width_m);
    if (!best || trial.map.cost < best->map.cost) best = std::move(trial);
  }
  return best;
}

}  // namespace mapproof
