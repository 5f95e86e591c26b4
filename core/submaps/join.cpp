#include "core/submaps/join.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/align/affine.hpp"
#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/planarity.hpp"
#include "core/model/submaps.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {
namespace {

/// In the plane the median residual of normal errors is 1.1774 standard deviations of a coordinate;
/// twice that.
constexpr double kTrusted = 2.0 / 1.1774;

Affine about_means(const Points& from, const Points& to, const Eigen::VectorXd& shares,
                   const Eigen::Matrix2d& linear) {
  const Eigen::RowVector2d source = shares.transpose() * from;
  const Eigen::RowVector2d target = shares.transpose() * to;
  return {.linear = linear, .offset = target - source * linear};
}

/// The map of that type that takes `from` closest to `to` in weighted least squares.
/// @param from, to  n x 2, finite, n >= 1.
/// @param weights   n, >= 0, with a positive sum.
/// @return One of the best where the points determine it only in part.
Affine fit_join(const Points& from, const Points& to, const Eigen::VectorXd& weights,
                JoinKind kind) {
  const Eigen::VectorXd shares = weights / weights.sum();
  const Points A = from.rowwise() - shares.transpose() * from;
  const Points B = to.rowwise() - shares.transpose() * to;
  const Eigen::Matrix2d cross = A.transpose() * shares.asDiagonal() * B;
  if (kind == JoinKind::kAffine) {
    const Eigen::Matrix2d own = A.transpose() * shares.asDiagonal() * A;
    const Eigen::Matrix2d linear = own.completeOrthogonalDecomposition().solve(cross);
    return about_means(from, to, shares, linear);
  }
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix2d linear = svd.matrixU() * svd.matrixV().transpose();
  const double spread = shares.dot(A.rowwise().squaredNorm());
  if (kind == JoinKind::kSimilarity && spread > 0.0) linear *= svd.singularValues().sum() / spread;
  return about_means(from, to, shares, linear);
}

/// Huber's weights of residuals: 1 up to some two standard deviations by their median, falling as
/// 1/r beyond.
Eigen::VectorXd huber_weights(const Eigen::VectorXd& residuals, double median) {
  const double trusted = std::max(kTrusted * median, 1e-12 * residuals.maxCoeff());
  if (!(trusted > 0.0)) return Eigen::VectorXd::Ones(residuals.size());
  return (trusted / residuals.array().max(trusted)).matrix();
}

/// The same with less trust in points that fit badly (Huber's weights about the median residual).
/// @param residual  Set to the RMS residual over the RMS radius of `to`, at those weights.
Affine fit_join_robustly(const Points& from, const Points& to, JoinKind kind, double& residual) {
  constexpr int kRounds = 20;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(from.rows());
  Affine fit;
  Eigen::VectorXd residuals;
  for (int round = 0; round < kRounds; ++round) {
    fit = fit_join(from, to, weights, kind);
    residuals = (fit(from) - to).rowwise().norm();
    const std::span<const double> values(residuals.data(),
                                         static_cast<std::size_t>(residuals.size()));
    weights = huber_weights(residuals, median(values));
  }
  const Points centred = to.rowwise() - to.colwise().mean();
  const double radius = std::sqrt(centred.squaredNorm() / static_cast<double>(to.rows()));
  residual =
      std::sqrt(weights.dot(residuals.cwiseAbs2()) / weights.sum()) / std::max(radius, 1e-300);
  return fit;
}

/// Two sub-maps that can be tied, and the fits of each to the other.
struct Overlap {
  int first = 0;
  int second = 0;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> shared;  ///< Rows in first and second.
  Affine to_first;                                            ///< Takes the second to the first.
  Affine to_second;                                           ///< And back.
  double residual = 0.0;                                      ///< Relative, the mean of both fits'.
  double cost = 0.0;  ///< The less the better: the residual over the root of the count.
};

/// Shared landmarks flatter than this leave the reflection to chance.
constexpr double kFlattest = 0.05;

std::vector<std::pair<Eigen::Index, Eigen::Index>> shared_rows(const Submap& first,
                                                               const Submap& second) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> rows;
  std::size_t j = 0;
  for (std::size_t i = 0; i < first.landmarks.size(); ++i) {
    while (j < second.landmarks.size() && second.landmarks[j] < first.landmarks[i]) ++j;
    if (j < second.landmarks.size() && second.landmarks[j] == first.landmarks[i])
      rows.emplace_back(i, j);
  }
  return rows;
}

/// All pairs of sub-maps with 3 landmarks or more in common that are not on one line in either.
std::vector<Overlap> overlaps_of(const std::vector<Submap>& maps, JoinKind kind) {
  std::vector<Overlap> overlaps;
  for (std::size_t g = 0; g < maps.size(); ++g)
    for (std::size_t h = g + 1; h < maps.size(); ++h) {
      Overlap overlap{.first = static_cast<int>(g),
                      .second = static_cast<int>(h),
                      .shared = shared_rows(maps[g], maps[h]),
                      .to_first = {},
                      .to_second = {}};
      const auto n = static_cast<Eigen::Index>(overlap.shared.size());
      if (n < 3) continue;
      Points in_first(n, 2), in_second(n, 2);
      for (Eigen::Index k = 0; k < n; ++k) {
        const auto& [i, j] = overlap.shared[static_cast<std::size_t>(k)];
        in_first.row(k) = maps[g].positions.row(i);
        in_second.row(k) = maps[h].positions.row(j);
      }
      if (planarity(in_first) < kFlattest || planarity(in_second) < kFlattest) continue;
      double there = 0.0, back = 0.0;
      overlap.to_first = fit_join_robustly(in_second, in_first, kind, there);
      overlap.to_second = fit_join_robustly(in_first, in_second, kind, back);
      overlap.residual = (there + back) / 2.0;
      overlap.cost = overlap.residual / std::sqrt(static_cast<double>(n));
      overlaps.push_back(std::move(overlap));
    }
  return overlaps;
}

/// Overlaps of least total cost that tie together what can be tied: their indices, ascending.
std::vector<std::size_t> spanning_tree(const std::vector<Overlap>& overlaps, std::size_t maps) {
  std::vector<std::size_t> order(overlaps.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return overlaps[k].cost; });
  std::vector<int> piece(maps);
  std::iota(piece.begin(), piece.end(), 0);
  std::vector<std::size_t> tree;
  for (const std::size_t k : order) {
    const int kept = piece[static_cast<std::size_t>(overlaps[k].first)];
    const int joined = piece[static_cast<std::size_t>(overlaps[k].second)];
    if (kept == joined) continue;
    std::ranges::replace(piece, joined, kept);
    tree.push_back(k);
  }
  std::ranges::sort(tree);
  return tree;
}

Affine after(const Affine& second, const Affine& first) {
  return {.linear = first.linear * second.linear,
          .offset = first.offset * second.linear + second.offset};
}

/// The transformation of each map; empty: it is in no tree with the root.
using Positions = std::vector<std::optional<Affine>>;

/// From one map outward along the tree.
Positions placed_from(int root, const std::vector<Overlap>& overlaps,
                      const std::vector<std::size_t>& tree, std::size_t maps) {
  Positions positions(maps);
  positions[static_cast<std::size_t>(root)] = Affine{};
  for (bool grew = true; grew;) {
    grew = false;
    for (const std::size_t k : tree) {
      auto& first = positions[static_cast<std::size_t>(overlaps[k].first)];
      auto& second = positions[static_cast<std::size_t>(overlaps[k].second)];
      if (first.has_value() == second.has_value()) continue;
      if (first)
        second = after(*first, overlaps[k].to_first);
      else
        first = after(*second, overlaps[k].to_second);
      grew = true;
    }
  }
  return positions;
}

/// The tree that holds most landmarks, from its largest map.
Positions largest_tree(const std::vector<Submap>& maps, const std::vector<Overlap>& overlaps,
                       const std::vector<std::size_t>& tree) {
  Positions best;
  std::size_t most = 0;
  std::vector<bool> tried(maps.size(), false);
  for (std::size_t g = 0; g < maps.size(); ++g) {
    if (tried[g]) continue;
    Positions positions = placed_from(static_cast<int>(g), overlaps, tree, maps.size());
    std::size_t landmarks = 0;
    for (std::size_t h = 0; h < maps.size(); ++h)
      if (positions[h]) {
        tried[h] = true;
        landmarks += maps[h].landmarks.size();
      }
    if (landmarks <= most) continue;
    most = landmarks;
    best = std::move(positions);
  }
  return best;
}

double scale_of(const Affine& map) { return std::sqrt(std::abs(map.linear.determinant())); }

/// Gives the maps the scales that agree best with those of all overlaps.
void even_scales(const std::vector<Overlap>& overlaps, std::vector<Submap>& maps) {
  const auto n = std::ssize(maps);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  A.diagonal().setConstant(1e-9);  // the mean of the logarithms is free
  for (const Overlap& overlap : overlaps) {
    const double ratio = 0.5 * std::log(scale_of(overlap.to_first) / scale_of(overlap.to_second));
    if (!std::isfinite(ratio)) continue;
    const double weight = 1.0 / (1e-6 + overlap.cost * overlap.cost);
    A(overlap.first, overlap.first) += weight;
    A(overlap.second, overlap.second) += weight;
    A(overlap.first, overlap.second) -= weight;
    A(overlap.second, overlap.first) -= weight;
    b(overlap.second) += weight * ratio;
    b(overlap.first) -= weight * ratio;
  }
  const Eigen::VectorXd logarithms = A.completeOrthogonalDecomposition().solve(b);
  for (std::ptrdiff_t g = 0; g < n; ++g)
    maps[static_cast<std::size_t>(g)].positions *= std::exp(logarithms(g));
}

/// Mean positions of all landmarks, and how far the maps are from them.
class Consensus {
 public:
  Consensus(std::vector<Submap>& maps, Eigen::Index landmarks)
      : maps_(maps), means_(landmarks, 2), counts_(landmarks) {
    for (const Submap& map : maps)
      weights_.push_back(Eigen::VectorXd::Ones(static_cast<Eigen::Index>(map.landmarks.size())));
  }

  void take_means() {
    means_.setZero();
    counts_.setZero();
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(counts_.size());
    for (std::size_t g = 0; g < maps_.size(); ++g) {
      if (!maps_[g].placed) continue;
      for (std::size_t k = 0; k < maps_[g].landmarks.size(); ++k) {
        const Eigen::Index landmark = maps_[g].landmarks[k];
        const double weight = weights_[g](static_cast<Eigen::Index>(k));
        means_.row(landmark) += weight * maps_[g].positions.row(static_cast<Eigen::Index>(k));
        sums(landmark) += weight;
        counts_(landmark) += 1.0;
      }
    }
    means_.array().colwise() /= sums.array();  // 0 / 0, NaN, where no map has the landmark
  }

  /// Less weight for positions that are far from their landmark's mean.
  void take_weights() {
    std::vector<double> distances;
    for (const Submap& map : maps_)
      for (std::size_t k = 0; map.placed && k < map.landmarks.size(); ++k)
        if (counts_(map.landmarks[k]) > 1.0) distances.push_back(distance(map, k));
    if (distances.empty()) return;
    const double middle = median(distances);
    for (std::size_t g = 0; g < maps_.size(); ++g) {
      if (!maps_[g].placed) continue;
      Eigen::VectorXd residuals(weights_[g].size());
      for (std::size_t k = 0; k < maps_[g].landmarks.size(); ++k)
        residuals(static_cast<Eigen::Index>(k)) = distance(maps_[g], k);
      weights_[g] = huber_weights(residuals, middle);
    }
  }

  /// Fits each map to the means of its shared landmarks; returns the largest shift of a landmark.
  double refit(JoinKind kind) {
    double shift = 0.0;
    for (std::size_t g = 0; g < maps_.size(); ++g) {
      Submap& map = maps_[g];
      if (!map.placed) continue;
      Eigen::VectorXd weights = weights_[g];
      for (std::size_t k = 0; k < map.landmarks.size(); ++k)
        if (counts_(map.landmarks[k]) < 2.0) weights(static_cast<Eigen::Index>(k)) = 0.0;
      if (!(weights.sum() > 0.0)) continue;
      const Points moved =
          fit_join(map.positions, means_(map.landmarks, Eigen::all), weights, kind)(map.positions);
      shift = std::max(shift, (moved - map.positions).rowwise().norm().maxCoeff());
      map.positions = moved;
    }
    return shift;
  }

  const Points& means() const { return means_; }

 private:
  double distance(const Submap& map, std::size_t k) const {
    return (map.positions.row(static_cast<Eigen::Index>(k)) - means_.row(map.landmarks[k])).norm();
  }

  std::vector<Submap>& maps_;
  Points means_;
  Eigen::VectorXd counts_;                ///< Placed maps that have the landmark.
  std::vector<Eigen::VectorXd> weights_;  ///< Of each map's landmarks.
};

/// Restores the covariance of all maps together: affine fits to means lose some of it each time,
/// and would end in a point.
class KeptSpread {
 public:
  explicit KeptSpread(const std::vector<Submap>& maps) : factor_(factor_of(maps)) {}

  void restore(std::vector<Submap>& maps) const {
    const Eigen::Matrix2d now = factor_of(maps);
    const Eigen::Matrix2d back =
        now.transpose().triangularView<Eigen::Upper>().solve(Eigen::Matrix2d(factor_.transpose()));
    if (!back.allFinite()) return;
    for (Submap& map : maps) map.positions = map.positions * back;
  }

 private:
  /// L with L L' the covariance of all positions of placed maps.
  static Eigen::Matrix2d factor_of(const std::vector<Submap>& maps) {
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    Eigen::RowVector2d sum = Eigen::RowVector2d::Zero();
    double count = 0.0;
    for (const Submap& map : maps) {
      if (!map.placed) continue;
      squares += map.positions.transpose() * map.positions;
      sum += map.positions.colwise().sum();
      count += static_cast<double>(map.positions.rows());
    }
    const Eigen::Matrix2d covariance = squares / count - sum.transpose() * sum / (count * count);
    return covariance.llt().matrixL();
  }

  Eigen::Matrix2d factor_;
};

double radius_of(const Points& points) {
  const Points centred = points.rowwise() - points.colwise().mean();
  return std::sqrt(centred.squaredNorm() / static_cast<double>(points.rows()));
}

/// Minimizes the distances of all maps to the mean positions of their shared landmarks.
Points refined(std::vector<Submap>& maps, JoinKind kind, Eigen::Index landmarks) {
  constexpr int kMostRounds = 500;
  Consensus consensus(maps, landmarks);
  const KeptSpread spread(maps);
  for (int round = 0; round < kMostRounds; ++round) {
    consensus.take_means();
    consensus.take_weights();
    consensus.take_means();
    const double shift = consensus.refit(kind);
    if (kind == JoinKind::kAffine) spread.restore(maps);
    if (shift <= 1e-7 * radius_of(maps.front().positions)) break;
  }
  consensus.take_means();
  return consensus.means();
}

SubmapJoin join_of(const Overlap& overlap, const std::vector<Submap>& maps) {
  const Submap& first = maps[static_cast<std::size_t>(overlap.first)];
  const Submap& second = maps[static_cast<std::size_t>(overlap.second)];
  SubmapJoin join{.first = overlap.first,
                  .second = overlap.second,
                  .shared = static_cast<int>(overlap.shared.size()),
                  .residual = kNaN,
                  .in_tree = false};
  if (!first.placed || !second.placed) return join;
  Points positions(join.shared, 2);
  double squares = 0.0;
  for (int k = 0; k < join.shared; ++k) {
    const auto& [i, j] = overlap.shared[static_cast<std::size_t>(k)];
    positions.row(k) = first.positions.row(i);
    squares += (first.positions.row(i) - second.positions.row(j)).squaredNorm();
  }
  join.residual = std::sqrt(squares / join.shared) / std::max(radius_of(positions), 1e-300);
  return join;
}

void check(const std::vector<Submap>& maps, JoinKind kind, Eigen::Index landmarks) {
  if (maps.empty() || kind == JoinKind::kRigid)
    throw InvalidInput("sub-maps are joined by similarities or affine maps, one or more of them");
  for (const Submap& map : maps) {
    if (map.landmarks.empty() || std::ssize(map.landmarks) != map.positions.rows() ||
        !map.positions.allFinite())
      throw InvalidInput("a sub-map needs a finite position for each of its landmarks");
    if (std::ranges::adjacent_find(map.landmarks, std::greater_equal<>()) != map.landmarks.end())
      throw InvalidInput("a sub-map's landmarks are not ascending");
    if (map.landmarks.front() < 0 || map.landmarks.back() >= landmarks)
      throw InvalidInput("a sub-map names landmarks that do not exist");
  }
}

}  // namespace

JoinResult join_submaps(std::vector<Submap> maps, JoinKind kind, Eigen::Index landmarks) {
  check(maps, kind, landmarks);
  // Scales come first: fitted together with the rest, they would shrink.
  if (kind == JoinKind::kSimilarity) even_scales(overlaps_of(maps, kind), maps);
  const JoinKind left = kind == JoinKind::kAffine ? kind : JoinKind::kRigid;
  const std::vector<Overlap> overlaps = overlaps_of(maps, left);
  const std::vector<std::size_t> tree = spanning_tree(overlaps, maps.size());
  const Positions positions = largest_tree(maps, overlaps, tree);

  JoinResult result;
  int left_out = 0;
  for (std::size_t g = 0; g < maps.size(); ++g) {
    maps[g].placed = positions[g].has_value();
    if (positions[g]) maps[g].positions = (*positions[g])(maps[g].positions);
    left_out += positions[g] ? 0 : 1;
  }
  result.joined.positions = refined(maps, left, landmarks);
  for (std::size_t k = 0; k < overlaps.size(); ++k) {
    result.joined.joins.push_back(join_of(overlaps[k], maps));
    result.joined.joins.back().in_tree = std::ranges::binary_search(tree, k);
  }
  if (left_out > 0)
    result.statuses.push_back(status_of<StatusReason::kSubmapsLeftOut>(left_out, maps.size()));
  result.joined.submaps = std::move(maps);
  return result;
}

}  // namespace mapproof
