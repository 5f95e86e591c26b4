#include "core/labels/label_doubts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace mapproof {
namespace {

constexpr double kFar = 0.25;           ///< Of the median distance.
constexpr std::size_t kNamed = 4;       ///< Landmarks.
constexpr double kWorse = 2.0;          ///< Than the middle landmark, to be named.
constexpr double kDeviations = 1.4826;  ///< Standard deviation over median of absolute values.

double middle(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, at);
  return *at;
}

/// The middle pair's spread of the blocks' distances about their median.
double spread_of(const std::vector<PairItem>& items) {
  std::map<std::pair<int, int>, std::vector<double>> distances;
  for (const PairItem& item : items)
    distances[{item.first, item.second}].push_back(item.distance_m);
  std::vector<double> spreads;
  for (auto& [pair, values] : distances) {
    if (values.size() < 3) continue;
    const double centre = middle(values);
    for (double& value : values) value = std::abs(value - centre);
    spreads.push_back(kDeviations * middle(values));
  }
  return middle(spreads);
}

}  // namespace

LabelDoubts label_doubts(const LabelledScans& scans, const std::vector<int>& labels,
                         const RobustMap& map) {
  const std::vector<PairItem> items = pair_items(scans.pairs, labels, scans.blocks);
  std::vector<double> distances;
  for (const PairItem& item : items) distances.push_back(item.distance_m);
  const double far = kFar * middle(distances);
  const Eigen::Index M = map.positions_m.rows();
  Eigen::ArrayXd squares = Eigen::ArrayXd::Zero(M);
  Eigen::ArrayXd weights = Eigen::ArrayXd::Zero(M);
  for (const PairItem& item : items) {
    const double between =
        (map.positions_m.row(item.first) - map.positions_m.row(item.second)).norm();
    if (std::isnan(between)) continue;
    const double residual = std::min(far, std::abs(item.distance_m - between));
    for (const int k : {item.first, item.second}) {
      squares(k) += item.weight * residual * residual;
      weights(k) += item.weight;
    }
  }
  LabelDoubts doubts;
  if (weights.sum() <= 0.0) return doubts;
  doubts.residual_m = std::sqrt(squares.sum() / weights.sum());
  doubts.spread_m = std::max(spread_of(items), 1e-3 * middle(distances));
  std::vector<double> worst;
  for (int k = 0; k < M; ++k)
    if (weights(k) > 0.0) {
      worst.push_back(squares(k) / weights(k));
      doubts.landmarks.push_back(k);
    }
  const double usual = middle(worst);
  const auto badness = [&](int k) { return squares(k) / weights(k); };
  std::ranges::stable_sort(doubts.landmarks, std::greater<>(), badness);
  std::erase_if(doubts.landmarks, [&](int k) { return badness(k) < kWorse * usual; });
  if (doubts.landmarks.size() > kNamed) doubts.landmarks.resize(kNamed);
  return doubts;
}

}  // namespace mapproof
