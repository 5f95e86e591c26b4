#include "core/association/move_contrast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>

#include "core/base/median.hpp"

namespace mapproof {
namespace {

constexpr int kSlicesOfCluster = 3;
constexpr std::size_t kFewestPulls = 12;  ///< Of a landmark whose contrast is computed.
constexpr std::size_t kFewestSlicesOfSide = 3;
constexpr double kNaiveShare = 0.75;  ///< Of the variance of independent pairs, added to the other.
constexpr int kContrastRounds = 6;
constexpr int kFewestClusters = 8;
constexpr double kBoundOfMany = 8.0;
constexpr double kBoundOfFew = 20.0;

/// A pair's distance, as it pulls at the landmark.
struct ContrastPull {
  int slice;
  int cluster;
  Eigen::Vector2d direction;  ///< From the other landmark.
  double residual;            ///< Measured less mapped distance, m.
  double weight;
};

/// Robot times time of each block.
std::vector<int> clusters_of(const LogBlocks& blocks) {
  constexpr int kMostSlices = 1000;
  std::vector<int> clusters;
  int robot = 0;
  for (std::size_t b = 0; b < blocks.slice.size(); ++b) {
    // Blocks come robot by robot, each robot's in order of time.
    if (b > 0 && blocks.slice[b] <= blocks.slice[b - 1]) ++robot;
    clusters.push_back(robot * kMostSlices + blocks.slice[b] / kSlicesOfCluster);
  }
  return clusters;
}

std::vector<ContrastPull> contrast_pulls(const std::vector<PairItem>& items, const RobustMap& map,
                                         const LogBlocks& blocks, const std::vector<int>& clusters,
                                         int landmark) {
  std::vector<ContrastPull> pulls;
  for (const PairItem& item : items) {
    if (item.first != landmark && item.second != landmark) continue;
    const int other = item.first == landmark ? item.second : item.first;
    const Eigen::RowVector2d away = map.positions_m.row(landmark) - map.positions_m.row(other);
    const double distance = away.norm();
    if (!(distance > 0.0)) continue;
    const auto block = static_cast<std::size_t>(item.block);
    pulls.push_back({blocks.slice[block], clusters[block], away.transpose() / distance,
                     item.distance_m - distance, item.weight});
  }
  return pulls;
}

/// The position of least Huber cost on one side of a time, and its variance.
struct Side {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  Eigen::Matrix2d variance = Eigen::Matrix2d::Zero();
  int clusters = 0;
  std::size_t slices = 0;
};

double huber_weight(const ContrastPull& pull, const Eigen::Vector2d& shift, double width) {
  const double residual = std::abs(pull.residual - pull.direction.dot(shift));
  return pull.weight * (residual > width ? width / residual : 1.0);
}

template <typename IsOnSide>
Side side_of(const std::vector<ContrastPull>& pulls, double width, const IsOnSide& is_on_side) {
  Side side;
  Eigen::Matrix2d inverse = Eigen::Matrix2d::Zero();
  for (int round = 0; round < kContrastRounds; ++round) {
    Eigen::Matrix2d H = 1e-6 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d g = Eigen::Vector2d::Zero();
    for (const ContrastPull& pull : pulls) {
      if (!is_on_side(pull.slice)) continue;
      const double weight = huber_weight(pull, side.shift, width);
      H += weight * pull.direction * pull.direction.transpose();
      g += weight * pull.residual * pull.direction;
    }
    const double determinant = H(0, 0) * H(1, 1) - H(0, 1) * H(1, 0);
    inverse << H(1, 1), -H(0, 1), -H(1, 0), H(0, 0);
    inverse /= determinant;
    side.shift = inverse * g;
  }
  std::map<int, Eigen::Vector2d> scores;
  std::set<int> slices;
  for (const ContrastPull& pull : pulls) {
    if (!is_on_side(pull.slice)) continue;
    slices.insert(pull.slice);
    const auto [at, is_new] = scores.try_emplace(pull.cluster, Eigen::Vector2d::Zero());
    at->second += huber_weight(pull, side.shift, width) *
                  (pull.residual - pull.direction.dot(side.shift)) * pull.direction;
  }
  Eigen::Matrix2d outer = Eigen::Matrix2d::Zero();
  for (const auto& [cluster, score] : scores) outer += score * score.transpose();
  const auto count = static_cast<double>(scores.size());
  const double sigma = width / 1.5;
  side.variance = count / std::max(count - 1.0, 0.5) * inverse * outer * inverse +
                  kNaiveShare * sigma * sigma * inverse;
  side.clusters = static_cast<int>(scores.size());
  side.slices = slices.size();
  return side;
}

MoveContrast contrast_of(const std::vector<ContrastPull>& pulls, int landmark, double width) {
  MoveContrast best{.landmark = landmark};
  int last = 0;
  for (const ContrastPull& pull : pulls) last = std::max(last, pull.slice);
  for (int cut = 2; cut < last; ++cut) {
    const Side before = side_of(pulls, width, [&](int slice) { return slice < cut; });
    const Side after = side_of(pulls, width, [&](int slice) { return slice >= cut; });
    if (std::min(before.slices, after.slices) < kFewestSlicesOfSide) continue;
    const Eigen::Matrix2d V = before.variance + after.variance;
    const Eigen::Vector2d shift = after.shift - before.shift;
    const double determinant = V(0, 0) * V(1, 1) - V(0, 1) * V(1, 0);
    if (!(determinant > 0.0)) continue;
    const double statistic = (V(1, 1) * shift(0) * shift(0) + V(0, 0) * shift(1) * shift(1) -
                              2.0 * V(0, 1) * shift(0) * shift(1)) /
                             determinant;
    if (statistic > best.statistic)
      best = {landmark, statistic, before.clusters + after.clusters, shift.norm(), cut};
  }
  return best;
}

}  // namespace

std::vector<MoveContrast> move_contrasts(const std::vector<PairItem>& items, const RobustMap& map,
                                         const LogBlocks& blocks) {
  const std::vector<int> clusters = clusters_of(blocks);
  std::vector<MoveContrast> contrasts;
  for (int k = 0; k < map.positions_m.rows(); ++k) {
    if (!map.positions_m.row(k).allFinite()) continue;
    std::vector<ContrastPull> pulls = contrast_pulls(items, map, blocks, clusters, k);
    std::erase_if(pulls, [](const ContrastPull& pull) { return !std::isfinite(pull.residual); });
    if (pulls.size() >= kFewestPulls) contrasts.push_back(contrast_of(pulls, k, map.width_m));
  }
  return contrasts;
}

double contrast_ratio(const std::vector<MoveContrast>& all, int landmark) {
  std::vector<double> statistics;
  for (const MoveContrast& one : all) statistics.push_back(one.statistic);
  const auto found = std::ranges::find(all, landmark, &MoveContrast::landmark);
  if (found == all.end() || found->clusters < kFewestClusters) return 0.0;
  const double usual = median(statistics);
  const double bound = found->clusters >= kManyClusters ? kBoundOfMany : kBoundOfFew;
  return usual > 0.0 ? found->statistic / usual / bound : 0.0;
}

}  // namespace mapproof
