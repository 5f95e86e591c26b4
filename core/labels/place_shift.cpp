#include "core/labels/place_shift.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/random.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {
namespace {

constexpr int kPlainlyLarge = 100;  ///< Permutations with as much, after which no more are drawn.
constexpr std::size_t kFewestSlices = 6;
constexpr int kDirections = 12;

/// A distance of the landmark from a known place, in a slice of time.
struct Pull {
  std::size_t slice;
  Eigen::RowVector2d from_m;
  double distance_m;
  double weight;
};

std::vector<Pull> pulls_of(const std::vector<PairItem>& items, const RobustMap& map,
                           const LogBlocks& blocks, int landmark) {
  std::vector<Pull> pulls;
  for (const PairItem& item : items) {
    if (item.first != landmark && item.second != landmark) continue;
    const Eigen::RowVector2d from =
        map.positions_m.row(item.first == landmark ? item.second : item.first);
    if (from.allFinite())
      pulls.push_back({static_cast<std::size_t>(blocks.slice[static_cast<std::size_t>(item.block)]),
                       from, item.distance_m, item.weight});
  }
  return pulls;
}

/// The places that are tried, the map's first.
std::vector<Eigen::RowVector2d> tried_places(const RobustMap& map, int landmark) {
  double reach = 0.0;
  for (Eigen::Index k = 0; k < map.positions_m.rows(); ++k)
    if (map.positions_m.row(k).allFinite())
      reach = std::max(reach, (map.positions_m.row(k) - map.positions_m.row(landmark)).norm());
  std::vector<Eigen::RowVector2d> places = {map.positions_m.row(landmark)};
  // Without noise the width is next to nothing: twenty circles reach a millionth of the map.
  for (double radius = std::max(map.width_m / 8.0, 1e-6 * reach);
       radius < 2.0 * reach && radius > 0.0; radius *= 2.0)
    for (int k = 0; k < kDirections; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      places.emplace_back(places.front() +
                          radius * Eigen::RowVector2d(std::cos(angle), std::sin(angle)));
    }
  return places;
}

/// What the pulls of each slice cost at each place.
Eigen::MatrixXd costs_of(const std::vector<Pull>& pulls,
                         const std::vector<Eigen::RowVector2d>& places, double width_m,
                         std::size_t slices) {
  Eigen::MatrixXd costs =
      Eigen::MatrixXd::Zero(std::ssize(places), static_cast<Eigen::Index>(slices));
  for (const Pull& pull : pulls)
    for (std::size_t i = 0; i < places.size(); ++i)
      costs(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(pull.slice)) +=
          pull.weight * huber_cost(pull.distance_m - (places[i] - pull.from_m).norm(), width_m);
  return costs;
}

/// How a pull asks for a shift from a place.
ShiftSlice asked(const Pull& pull, const Eigen::RowVector2d& place, double width_m) {
  const Eigen::RowVector2d away = place - pull.from_m;
  const double distance = away.norm();
  if (!(distance > 0.0)) return {};
  const Eigen::Vector2d direction = away.transpose() / distance;
  const double residual = pull.distance_m - distance;
  const double weight = pull.weight * std::min(1.0, width_m / std::max(std::abs(residual), 1e-300));
  return {weight * direction * direction.transpose(), weight * residual * direction};
}

/// H^-1 g, and nothing in a direction that no pair measures.
Eigen::Vector2d shift_by(const ShiftSlice& sum) {
  const double ridge = 1e-9 * sum.H.trace();
  const double a = sum.H(0, 0) + ridge;
  const double b = sum.H(0, 1);
  const double c = sum.H(1, 1) + ridge;
  const double determinant = a * c - b * b;
  if (!(determinant > 0.0)) return {0.0, 0.0};
  return {(c * sum.g(0) - b * sum.g(1)) / determinant, (a * sum.g(1) - b * sum.g(0)) / determinant};
}

double fall(const ShiftSlice& sum) { return 0.5 * sum.g.dot(shift_by(sum)); }

/// The place near `place` where the pulls of the slices [first, last) cost least.
Eigen::RowVector2d settled(const std::vector<Pull>& pulls, Eigen::RowVector2d place,
                           std::size_t first, std::size_t last, double width_m) {
  constexpr int kRounds = 20;
  for (int round = 0; round < kRounds; ++round) {
    ShiftSlice sum;
    for (const Pull& pull : pulls) {
      if (pull.slice < first || pull.slice >= last) continue;
      const ShiftSlice one = asked(pull, place, width_m);
      sum.H += one.H;
      sum.g += one.g;
    }
    place += shift_by(sum).transpose();
  }
  return place;
}

struct Split {
  double cost = 0.0;
  std::size_t first = 0;  ///< Slice of the second place; 0: none.
  Eigen::Index old = 0;
  Eigen::Index fresh = 0;  ///< Rows of the places.
};

Split best_split(const Eigen::MatrixXd& costs) {
  std::vector<Eigen::Index> shown;
  for (Eigen::Index k = 0; k < costs.cols(); ++k)
    if (costs.col(k).maxCoeff() > 0.0) shown.push_back(k);
  Eigen::VectorXd after = costs.rowwise().sum();
  Eigen::VectorXd before = Eigen::VectorXd::Zero(costs.rows());
  Split best{after.minCoeff(), 0, 0, 0};
  for (std::size_t k = 0; k + 2 < shown.size(); ++k) {
    before += costs.col(shown[k]);
    after -= costs.col(shown[k]);
    if (k == 0) continue;
    Eigen::Index old = 0;
    Eigen::Index fresh = 0;
    const double cost = before.minCoeff(&old) + after.minCoeff(&fresh);
    if (cost < best.cost) best = {cost, static_cast<std::size_t>(shown[k + 1]), old, fresh};
  }
  return best;
}

template <typename Value>
void shuffle(std::vector<Value>& values, Random& random) {
  for (std::size_t k = values.size(); k-- > 1;)
    std::swap(values[k],
              values[static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1))]);
}

/// The share of permutations whose gain, inflated, is as much; the change itself among them.
double share_of(std::vector<ShiftSlice> slices, double gain, double inflation, int count,
                Random& random) {
  int as_much = 1;
  int drawn = 1;
  while (drawn <= count && as_much < kPlainlyLarge) {
    shuffle(slices, random);
    as_much += inflation * best_gain(slices) >= gain ? 1 : 0;
    ++drawn;
  }
  return static_cast<double>(as_much) / drawn;
}

}  // namespace

double best_gain(const std::vector<ShiftSlice>& slices) {
  ShiftSlice all;
  for (const ShiftSlice& slice : slices) {
    all.H += slice.H;
    all.g += slice.g;
  }
  double best = 0.0;
  ShiftSlice before;
  for (std::size_t k = 0; k + 2 < slices.size(); ++k) {
    before.H += slices[k].H;
    before.g += slices[k].g;
    if (k > 0) best = std::max(best, fall(before) + fall({all.H - before.H, all.g - before.g}));
  }
  return best - fall(all);
}

PlaceChange best_change(const std::vector<PairItem>& items, const RobustMap& map,
                        const LogBlocks& blocks, int landmark) {
  PlaceChange change;
  const std::vector<Pull> pulls = pulls_of(items, map, blocks, landmark);
  if (pulls.empty()) return change;
  const std::size_t slices = static_cast<std::size_t>(*std::ranges::max_element(blocks.slice)) + 1;
  const std::vector<Eigen::RowVector2d> places = tried_places(map, landmark);
  const Split split = best_split(costs_of(pulls, places, map.width_m, slices));
  if (split.first == 0) return change;
  change.first = split.first;
  const Eigen::RowVector2d old_m =
      settled(pulls, places[static_cast<std::size_t>(split.old)], 0, split.first, map.width_m);
  const Eigen::RowVector2d new_m = settled(pulls, places[static_cast<std::size_t>(split.fresh)],
                                           split.first, slices, map.width_m);
  std::vector<ShiftSlice> residual(slices);
  for (const Pull& pull : pulls) {
    const ShiftSlice one = asked(pull, pull.slice < split.first ? old_m : new_m, map.width_m);
    residual[pull.slice].H += one.H;
    residual[pull.slice].g += one.g;
  }
  const Eigen::Vector2d apart = (new_m - old_m).transpose();
  for (std::size_t k = 0; k < slices; ++k) {
    if (residual[k].H.trace() == 0.0) continue;
    change.residual.push_back(residual[k]);
    change.asked.push_back(residual[k]);
    if (k >= split.first) change.asked.back().g += residual[k].H * apart;
  }
  return change;
}

double chance_of(const PlaceChange& change, const PermutationOptions& options) {
  if (change.residual.size() < kFewestSlices) return 1.0;
  Random random(options.seed);
  const double gain = best_gain(change.asked);
  const double alone = share_of(change.asked, gain, 1.0, options.count, random);
  return std::max(alone, share_of(change.residual, gain, options.inflation, options.count, random));
}

double inflation(const std::vector<PlaceChange>& landmarks, std::uint64_t seed) {
  constexpr int kShuffles = 39;
  Random random(seed);
  std::vector<double> ratios;
  for (const PlaceChange& change : landmarks) {
    if (change.residual.size() < kFewestSlices) continue;
    std::vector<ShiftSlice> shuffled = change.residual;
    std::vector<double> gains;
    for (int k = 0; k < kShuffles; ++k) {
      shuffle(shuffled, random);
      gains.push_back(best_gain(shuffled));
    }
    const double by_chance = median(gains);
    if (by_chance > 0.0) ratios.push_back(best_gain(change.asked) / by_chance);
  }
  return ratios.empty() ? 1.0 : std::max(1.0, median(ratios));
}

}  // namespace mapproof
