#include "core/association/anchor_ids.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numeric>
#include <utility>

#include "core/association/identified_scans.hpp"
#include "core/association/robust_map.hpp"
#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/pairs/pair_map.hpp"

namespace mapproof {
namespace {

using Exchange = std::pair<int, int>;
using Exchanges = std::vector<Exchange>;

constexpr std::size_t kMostDoubted = 40;  ///< Landmarks with a known position whose IDs are tested.
constexpr double kHuberWidths = 2.0;     ///< Of Huber's cost, in standard deviations of a position.
constexpr double kLeastEvidence = 30.0;  ///< Variances that an exchange has to explain,
constexpr double kLeastLead = 10.0;      ///< and those by which it has to lead any other.
constexpr double kMostLeft = 5.0;        ///< Deviations that its landmarks may be off then.

/// How well a map fits the known positions.
struct Fit {
  std::vector<double> misses_m;  ///< Of each known position.
  double cost = 0.0;             ///< Sum of Huber costs, m^2.
};

/// A map and the known positions of its landmarks.
class KnownPositions {
 public:
  KnownPositions(const Points& map_m, const Points& known_m) {
    for (Eigen::Index k = 0; k < map_m.rows(); ++k) {
      map_.emplace_back(map_m(k, 0), map_m(k, 1));
      if (!known_m.row(k).allFinite() || !map_m.row(k).allFinite()) continue;
      rows_.push_back(static_cast<int>(k));
      known_.emplace_back(known_m(k, 0), known_m(k, 1));
    }
  }

  const std::vector<int>& rows() const { return rows_; }
  std::size_t landmarks() const { return map_.size(); }
  bool mapped(int landmark) const {
    return std::isfinite(map_[static_cast<std::size_t>(landmark)].real());
  }

  /// The similarity of least Huber cost, by reweighted least squares.
  Fit fit(const Exchanges& exchanges, double deviation_m, bool mirrored = false) const {
    std::vector<std::complex<double>> from = positions(exchanges);
    if (mirrored)
      for (std::complex<double>& z : from) z = std::conj(z);
    const double width = kHuberWidths * deviation_m;
    std::vector<double> weights(from.size(), 1.0);
    Fit fit;
    for (int round = 0; round < 12; ++round) {
      fit = {misses(from, weights), 0.0};
      for (std::size_t k = 0; k < from.size(); ++k) {
        weights[k] = width / std::max(width, fit.misses_m[k]);
        fit.cost += huber_cost(fit.misses_m[k], width);
      }
    }
    return fit;
  }

 private:
  std::vector<std::complex<double>> positions(const Exchanges& exchanges) const {
    std::vector<std::complex<double>> map = map_;
    for (const auto& [a, b] : exchanges)
      std::swap(map[static_cast<std::size_t>(a)], map[static_cast<std::size_t>(b)]);
    std::vector<std::complex<double>> chosen;
    for (const int row : rows_) chosen.push_back(map[static_cast<std::size_t>(row)]);
    return chosen;
  }

  std::vector<double> misses(const std::vector<std::complex<double>>& from,
                             const std::vector<double>& weights) const {
    std::complex<double> from_mean;
    std::complex<double> known_mean;
    const double all = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (std::size_t k = 0; k < from.size(); ++k) {
      from_mean += weights[k] / all * from[k];
      known_mean += weights[k] / all * known_[k];
    }
    std::complex<double> product;
    double square = 0.0;
    for (std::size_t k = 0; k < from.size(); ++k) {
      product += weights[k] * std::conj(from[k] - from_mean) * (known_[k] - known_mean);
      square += weights[k] * std::norm(from[k] - from_mean);
    }
    const std::complex<double> turn = square > 0.0 ? product / square : 0.0;
    std::vector<double> misses;
    for (std::size_t k = 0; k < from.size(); ++k)
      misses.push_back(std::abs(known_[k] - known_mean - turn * (from[k] - from_mean)));
    return misses;
  }

  std::vector<std::complex<double>> map_;
  std::vector<int> rows_;
  std::vector<std::complex<double>> known_;
};

double root_mean_square(const Fit& fit) {
  double sum = 0.0;
  for (const double miss : fit.misses_m) sum += miss * miss;
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, fit.misses_m.size())));
}

/// The standard deviation of a position, from the median miss; a similarity hides four of 2 k
/// misses.
double deviation_of(const Fit& fit) {
  const double positions = static_cast<double>(fit.misses_m.size());
  return upper_median(fit.misses_m) / 1.18 * std::sqrt(positions / (positions - 2.0));
}

/// A landmark with a known position comes first; of two, the lower.
Exchange in_order(const KnownPositions& positions, int known, int other) {
  if (std::ranges::binary_search(positions.rows(), other) && other < known) return {other, known};
  return {known, other};
}

/// All exchanges that involve one of the known positions that fit worst.
Exchanges candidates(const KnownPositions& positions, const Fit& given) {
  std::vector<std::size_t> order(positions.rows().size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](std::size_t k) { return given.misses_m[k]; });
  order.resize(std::min(order.size(), kMostDoubted));
  std::vector<char> done(positions.landmarks(), 0);
  Exchanges result;
  for (const std::size_t k : order) {
    const int a = positions.rows()[k];
    done[static_cast<std::size_t>(a)] = 1;
    for (std::size_t b = 0; b < positions.landmarks(); ++b)
      if (done[b] == 0 && positions.mapped(static_cast<int>(b)))
        result.push_back(in_order(positions, a, static_cast<int>(b)));
  }
  return result;
}

/// The exchanges and one more, or an infinite cost if that shares an ID with one of them.
double cost_with(const KnownPositions& positions, Exchanges exchanges, const Exchange& one,
                 double deviation_m) {
  for (const auto& [a, b] : exchanges)
    if (a == one.first || a == one.second || b == one.first || b == one.second) return kInfinity;
  exchanges.push_back(one);
  return positions.fit(exchanges, deviation_m).cost;
}

/// The exchanges that reduce the cost the most, one after another.
Exchanges lowest(const KnownPositions& positions, const Exchanges& tried, double deviation_m) {
  const std::size_t most = (positions.rows().size() - 2) / 2;
  Exchanges chosen;
  double cost = positions.fit({}, deviation_m).cost;
  while (chosen.size() < most) {
    double best_cost = cost;
    Exchange best;
    for (const Exchange& one : tried)
      if (const double other = cost_with(positions, chosen, one, deviation_m); other < best_cost) {
        best_cost = other;
        best = one;
      }
    if (cost - best_cost < kLeastEvidence * deviation_m * deviation_m) break;
    cost = best_cost;
    chosen.push_back(best);
  }
  return chosen;
}

/// Whether the landmarks of the exchanges are where they then should be.
bool in_place(const KnownPositions& positions, const Exchanges& chosen, const Fit& fit,
              double deviation_m) {
  for (std::size_t k = 0; k < positions.rows().size(); ++k)
    for (const auto& [a, b] : chosen)
      if ((positions.rows()[k] == a || positions.rows()[k] == b) &&
          fit.misses_m[k] > kMostLeft * deviation_m)
        return false;
  return true;
}

/// Whether each exchange is needed, and none could replace it.
/// @param least_m  No position is taken to be more certain than this.
bool decided(const KnownPositions& positions, const Exchanges& chosen, const Exchanges& tried,
             double least_m) {
  const Fit fit = positions.fit(chosen, least_m);
  const double deviation = std::max(deviation_of(fit), least_m);
  if (!in_place(positions, chosen, fit, deviation)) return false;
  const double variance = deviation * deviation;
  const double cost = positions.fit(chosen, deviation).cost;
  // A reflected map, as with bearings of the other sign, is not an ID swap.
  if (positions.fit({}, deviation, true).cost < cost + kLeastEvidence * variance) return false;
  for (std::size_t k = 0; k < chosen.size(); ++k) {
    Exchanges others = chosen;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
    if (positions.fit(others, deviation).cost < cost + kLeastEvidence * variance) return false;
    for (const Exchange& one : tried)
      if (one != chosen[k] &&
          cost_with(positions, others, one, deviation) < cost + kLeastLead * variance)
        return false;
  }
  return true;
}

/// The standard deviation of the pairs' residuals, from their median.
double deviation_of(const PairMap& map) {
  const Points& points = map.embedding.coordinates;
  std::vector<double> residuals = {0.0};
  double longest = 0.0;
  for (const MeasuredPair& pair : map.pairs) {
    const double distance = (points.row(pair.first) - points.row(pair.second)).norm();
    if (std::isnan(distance)) continue;
    residuals.push_back(std::abs(distance - pair.distance_m));
    longest = std::max(longest, pair.distance_m);
  }
  return std::max({1.48 * upper_median(std::move(residuals)), 1e-3 * longest, 1e-9});
}

DetectionLog exchanged(const DetectionLog& log, const Exchanges& exchanges) {
  std::vector<int> ids = given_ids(log);
  for (const auto& [a, b] : exchanges)
    for (int& id : ids) id = id == a ? b : id == b ? a : id;
  return reassigned(log, ids);
}

}  // namespace

AnchorCheck check_anchor_ids(const DetectionLog& log, const Points& known_m) {
  if (known_m.rows() != std::ssize(log.names))
    throw InvalidInput("known positions need one row per landmark");
  const PairMap map = pair_map_of(log);
  const KnownPositions positions(map.embedding.coordinates, known_m);
  AnchorCheck check;
  check.positions = static_cast<int>(positions.rows().size());
  check.repaired = log;
  if (check.positions < kFewestKnownPositions) return check;
  const double deviation = deviation_of(map);
  const Fit given = positions.fit({}, deviation);
  check.misfit_before_m = check.misfit_after_m = root_mean_square(given);
  const Exchanges tried = candidates(positions, given);
  Exchanges chosen = lowest(positions, tried, deviation);
  while (!chosen.empty() && !decided(positions, chosen, tried, deviation)) chosen.pop_back();
  Exchanges undone;
  for (const Exchange& one : chosen) {
    undone.push_back(one);
    const double misfit = root_mean_square(positions.fit(undone, deviation));
    check.exchanges.push_back({one.first, one.second, check.misfit_after_m, misfit});
    check.misfit_after_m = misfit;
  }
  check.repaired = exchanged(log, chosen);
  return check;
}

}  // namespace mapproof
