#include "core/pairs/pair_distances.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/statistics/intervals.hpp"
#include "core/statistics/robust_noise.hpp"

namespace mapproof {
namespace {

constexpr double kMostValues = 2.5e7;
constexpr double kMostScans = 2000.0;  ///< Of a pair: a median of more is hardly better.
constexpr double kFewestScans = 5.0;

/// Calls `visit(first, second)` for every two detections of one scan that measured both numbers.
template <typename Visit>
void for_each_pair(const std::vector<Detection>& detections, const Visit& visit) {
  const auto is_whole = [](const Detection& seen) {
    return !std::isnan(seen.range_m) && !std::isnan(seen.bearing_rad);
  };
  for (auto first = detections.begin(); first != detections.end();) {
    const auto last = std::find_if(
        first, detections.end(), [&](const Detection& other) { return other.step != first->step; });
    for (auto a = first; a != last; ++a) {
      if (!is_whole(*a)) continue;
      for (auto b = a + 1; b != last; ++b)
        if (is_whole(*b)) visit(*a, *b);
    }
    first = last;
  }
}

/// The scans that saw each pair: counted, then a spread of their distances gathered.
class PairScans {
 public:
  explicit PairScans(const DetectionLog& log) {
    const auto M = static_cast<Eigen::Index>(log.names.size());
    index_ = Eigen::MatrixXi::Zero(M, M);
    for_each_pair(log.detections, [&](const Detection& a, const Detection& b) { ++at(a, b); });
    for (Eigen::Index i = 0; i < M; ++i)
      for (Eigen::Index j = i + 1; j < M; ++j) {
        if (index_(j, i) == 0) continue;
        pairs_.push_back({.first = i, .second = j, .scans = index_(j, i)});
        index_(j, i) = static_cast<int>(pairs_.size());
      }
    gather(log);
  }

  const std::vector<MeasuredPair>& pairs() const { return pairs_; }

  std::span<const double> distances(std::size_t pair) const {
    return {values_.data() + first_[pair], first_[pair + 1] - first_[pair]};
  }

 private:
  int& at(const Detection& a, const Detection& b) { return index_(b.landmark, a.landmark); }

  void gather(const DetectionLog& log) {
    const double share = kMostValues / std::max(1.0, static_cast<double>(pairs_.size()));
    const int most = static_cast<int>(std::clamp(share, kFewestScans, kMostScans));
    std::vector<int> stride;
    first_.push_back(0);
    for (const MeasuredPair& pair : pairs_) {
      stride.push_back((pair.scans + most - 1) / most);
      first_.push_back(first_.back() +
                       static_cast<std::size_t>((pair.scans - 1) / stride.back() + 1));
    }
    values_.resize(first_.back());
    std::vector<int> seen(pairs_.size(), 0);
    for_each_pair(log.detections, [&](const Detection& a, const Detection& b) {
      const auto pair = static_cast<std::size_t>(at(a, b) - 1);
      const int scan = seen[pair]++;
      if (scan % stride[pair] == 0)
        values_[first_[pair] + static_cast<std::size_t>(scan / stride[pair])] = scan_distance(a, b);
    });
  }

  Eigen::MatrixXi index_;  ///< Below the diagonal: scans of the pair, later its number from 1.
  std::vector<MeasuredPair> pairs_;
  std::vector<std::size_t> first_;  ///< Of each pair among the values, and their end.
  std::vector<double> values_;
};

void check(const DetectionLog& log, const PairNoise& noise) {
  for (const double option : {noise.relative, noise.floor, noise.prior_scans})
    if (!(option >= 0.0 && std::isfinite(option)))
      throw InvalidInput("the noise of measured pairs must be finite and not negative");
  int step = 0;
  int landmark = -1;
  for (const Detection& seen : log.detections) {
    if (seen.step < step || (seen.step == step && seen.landmark <= landmark) ||
        seen.landmark >= std::ssize(log.names))
      throw InvalidInput("detections must ascend by step and landmark, and name landmarks");
    if (std::isinf(seen.range_m) || std::isinf(seen.bearing_rad) || seen.range_m < 0.0)
      throw InvalidInput("ranges and bearings must be finite, ranges not negative");
    step = seen.step;
    landmark = seen.landmark;
  }
}

/// @param scatter  Of each pair's scans.
void set_precisions(std::vector<MeasuredPair>& pairs, const std::vector<double>& scatter,
                    const PairNoise& noise) {
  std::vector<double> distances;
  for (const MeasuredPair& pair : pairs) distances.push_back(pair.distance_m);
  const double floor = noise.floor * median(distances);
  const double common = median(scatter);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const double scans = pairs[k].scans;
    const double squares = scans * scatter[k] * scatter[k] + noise.prior_scans * common * common;
    const double relative = noise.relative * pairs[k].distance_m;
    const double variance =
        floor * floor + relative * relative + squares / (scans + noise.prior_scans) / scans;
    // Beyond a double where nothing scatters and no noise is assumed: then the precision is the
    // count.
    pairs[k].precision = 1.0 / std::max(variance, 1e-24 / scans);
  }
}

}  // namespace

double scan_distance(const Detection& a, const Detection& b) {
  const double sine = std::sin(0.5 * (a.bearing_rad - b.bearing_rad));
  const double difference = a.range_m - b.range_m;
  return std::sqrt(difference * difference + 4.0 * std::abs(a.range_m * b.range_m) * sine * sine);
}

std::vector<MeasuredPair> measured_pairs(const DetectionLog& log, const PairNoise& noise) {
  check(log, noise);
  const PairScans scans(log);
  std::vector<MeasuredPair> pairs = scans.pairs();
  if (pairs.empty()) return pairs;
  std::vector<double> scatter;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const RobustNoise own = robust_noise(scans.distances(k));
    pairs[k].distance_m = own.median;
    scatter.push_back(own.sigma);
  }
  set_precisions(pairs, scatter, noise);
  return pairs;
}

}  // namespace mapproof
