#include "core/evaluate/landmark_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/base/median.hpp"

namespace mapproof {
namespace {

/// A landmark of the ground truth and the one of the estimate that is associated with it.
using LandmarkPair = std::pair<Eigen::Index, Eigen::Index>;

Alignment plane_alignment(FrameAlignment alignment) {
  return alignment == FrameAlignment::kSimilarity ? Alignment::kSimilarity : Alignment::kRigid;
}

bool is_fitted(const LandmarkEvaluationOptions& options) {
  return !options.known && options.alignment != FrameAlignment::kNone;
}

Points transformed(const SpaceSimilarity& map, const Points& points) {
  SpacePoints space = SpacePoints::Zero(points.rows(), 3);
  space.leftCols<2>() = points;
  return map(space).leftCols<2>();
}

std::vector<LandmarkPair> pairs_by_name(const LandmarkPositions& ground_truth,
                                        const LandmarkPositions& estimate) {
  std::map<std::string, Eigen::Index> rows;
  for (std::size_t i = 0; i < estimate.names.size(); ++i)
    rows[estimate.names[i]] = static_cast<Eigen::Index>(i);
  std::vector<LandmarkPair> pairs;
  for (std::size_t i = 0; i < ground_truth.names.size(); ++i)
    if (const auto row = rows.find(ground_truth.names[i]); row != rows.end())
      pairs.emplace_back(static_cast<Eigen::Index>(i), row->second);
  return pairs;
}

/// One to one, the nearest pairs first, none farther apart than the gate.
std::vector<LandmarkPair> nearest_pairs(const Points& ground_truth_m, const Points& estimate_m,
                                        double gate_m) {
  std::vector<std::tuple<double, Eigen::Index, Eigen::Index>> candidates;
  for (Eigen::Index i = 0; i < ground_truth_m.rows(); ++i)
    for (Eigen::Index k = 0; k < estimate_m.rows(); ++k)
      if (const double gap_m = (ground_truth_m.row(i) - estimate_m.row(k)).norm(); gap_m <= gate_m)
        candidates.emplace_back(gap_m, i, k);
  std::ranges::sort(candidates);
  std::vector<bool> is_taken(static_cast<std::size_t>(ground_truth_m.rows())),
      is_used(static_cast<std::size_t>(estimate_m.rows()));
  std::vector<LandmarkPair> pairs;
  for (const auto& [gap_m, i, k] : candidates) {
    if (is_taken[static_cast<std::size_t>(i)] || is_used[static_cast<std::size_t>(k)]) continue;
    is_taken[static_cast<std::size_t>(i)] = is_used[static_cast<std::size_t>(k)] = true;
    pairs.emplace_back(i, k);
  }
  std::ranges::sort(pairs);
  return pairs;
}

Similarity fit(const Points& ground_truth_m, const Points& estimate_m,
               const std::vector<LandmarkPair>& pairs, FrameAlignment alignment) {
  Points from(std::ssize(pairs), 2), to(std::ssize(pairs), 2);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    to.row(static_cast<Eigen::Index>(i)) = ground_truth_m.row(pairs[i].first);
    from.row(static_cast<Eigen::Index>(i)) = estimate_m.row(pairs[i].second);
  }
  return fit_similarity(from, to, plane_alignment(alignment));
}

double default_gate(const Points& ground_truth_m) {
  std::vector<double> nearest_m;
  for (Eigen::Index i = 0; i < ground_truth_m.rows(); ++i) {
    double least_m = HUGE_VAL;
    for (Eigen::Index k = 0; k < ground_truth_m.rows(); ++k)
      if (k != i)
        least_m = std::min(least_m, (ground_truth_m.row(i) - ground_truth_m.row(k)).norm());
    if (std::isfinite(least_m)) nearest_m.push_back(least_m);
  }
  if (nearest_m.empty()) throw InvalidInput("landmarks without IDs need a gate in metres");
  return 0.5 * median(nearest_m);
}

/// Seeks the alignment of the least sum over the landmarks of the ground truth: of the squared
/// distance to the nearest one of the map, or of the squared gate where that is farther
/// [torr2000]. With a wide gate many alignments give every landmark a partner.
class Registration {
 public:
  Registration(const Points& ground_truth_m, const Points& estimate_m, FrameAlignment alignment,
               double gate_m)
      : ground_truth_m_(ground_truth_m),
        estimate_m_(estimate_m),
        alignment_(alignment),
        gate_m_(gate_m) {}

  Similarity find() {
    const Eigen::Index enough = std::min(ground_truth_m_.rows(), estimate_m_.rows());
    for (const auto& [a, b] : longest_first(estimate_m_)) {
      for (Eigen::Index c = 0; c < ground_truth_m_.rows(); ++c)
        for (Eigen::Index d = 0; d < ground_truth_m_.rows(); ++d)
          if (c != d) try_pairs({c, a}, {d, b});
      if (distances_ > kMostDistances || (most_ >= enough && distances_ > kEnoughDistances)) break;
    }
    return refined();
  }

 private:
  /// Some 2 s; and 0.2 s, where every landmark has a partner by then.
  static constexpr double kMostDistances = 1e9, kEnoughDistances = 1e8;

  static std::vector<std::pair<Eigen::Index, Eigen::Index>> longest_first(const Points& points) {
    std::vector<std::tuple<double, Eigen::Index, Eigen::Index>> all;
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      for (Eigen::Index k = i + 1; k < points.rows(); ++k)
        all.emplace_back(-(points.row(i) - points.row(k)).norm(), i, k);
    std::ranges::sort(all);
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
    for (const auto& [length, i, k] : all) pairs.emplace_back(i, k);
    return pairs;
  }

  void try_pairs(const LandmarkPair& first, const LandmarkPair& second) {
    const double real_m =
        (ground_truth_m_.row(first.first) - ground_truth_m_.row(second.first)).norm();
    const double map_m = (estimate_m_.row(first.second) - estimate_m_.row(second.second)).norm();
    // Each of the two may be off by the gate.
    const bool fits = alignment_ == FrameAlignment::kSimilarity
                          ? real_m > 2.0 * gate_m_ && map_m > 0.0
                          : std::abs(real_m - map_m) <= 2.0 * gate_m_;
    if (!fits || distances_ > kMostDistances) return;
    const Similarity map = fit(ground_truth_m_, estimate_m_, {first, second}, alignment_);
    const Points aligned_m = map(estimate_m_);
    distances_ += static_cast<double>(ground_truth_m_.rows() * aligned_m.rows());
    Eigen::Index count = 0;
    double cost = 0.0;
    for (Eigen::Index i = 0; i < ground_truth_m_.rows(); ++i) {
      const double gap =
          (aligned_m.rowwise() - ground_truth_m_.row(i)).rowwise().squaredNorm().minCoeff();
      count += gap <= gate_m_ * gate_m_;
      cost += std::min(gap, gate_m_ * gate_m_);
    }
    most_ = std::max(most_, count);
    if (cost >= least_) return;
    least_ = cost;
    best_ = map;
  }

  Similarity refined() const {
    constexpr int kMostRounds = 50;
    Similarity map = best_;
    std::vector<LandmarkPair> before;
    for (int round = 0; round < kMostRounds; ++round) {
      const std::vector<LandmarkPair> pairs =
          nearest_pairs(ground_truth_m_, map(estimate_m_), gate_m_);
      if (pairs.size() < 2 || pairs == before) break;
      map = fit(ground_truth_m_, estimate_m_, pairs, alignment_);
      before = pairs;
    }
    return map;
  }

  const Points& ground_truth_m_;
  const Points& estimate_m_;
  FrameAlignment alignment_;
  double gate_m_;
  double distances_ = 0.0;
  Eigen::Index most_ = 0;  // Landmarks of the ground truth with a partner within the gate.
  double least_ = HUGE_VAL;
  Similarity best_;
};

void require(std::size_t pairs, std::size_t needed, const LandmarkPositions& ground_truth,
             const LandmarkPositions& estimate) {
  if (pairs >= needed) return;
  throw InvalidInput(fmt::format(
      "{} of {} landmarks of the ground truth and {} of the map are associated; {} are needed",
      pairs, ground_truth.names.size(), estimate.names.size(), needed));
}

}  // namespace

LandmarkEvaluation evaluate_landmarks(const LandmarkPositions& ground_truth,
                                      const LandmarkPositions& estimate,
                                      const LandmarkEvaluationOptions& options) {
  if (options.gate_m && !(*options.gate_m > 0.0 && std::isfinite(*options.gate_m)))
    throw InvalidInput("the gate must be a number of metres above 0");
  if (options.alignment == FrameAlignment::kFirstPose && !options.known)
    throw InvalidInput("a map without a path cannot be aligned by its first pose");
  Points map_m =
      options.known ? transformed(*options.known, estimate.positions_m) : estimate.positions_m;
  std::vector<LandmarkPair> pairs;
  if (options.association == LandmarkAssociation::kId) {
    pairs = pairs_by_name(ground_truth, estimate);
    require(pairs.size(), is_fitted(options) ? 2 : 1, ground_truth, estimate);
    if (is_fitted(options))
      map_m = fit(ground_truth.positions_m, map_m, pairs, options.alignment)(map_m);
  } else {
    const double gate_m = options.gate_m ? *options.gate_m : default_gate(ground_truth.positions_m);
    if (is_fitted(options))
      map_m =
          Registration(ground_truth.positions_m, estimate.positions_m, options.alignment, gate_m)
              .find()(map_m);
    pairs = nearest_pairs(ground_truth.positions_m, map_m, gate_m);
    require(pairs.size(), is_fitted(options) ? 3 : 1, ground_truth, estimate);
  }
  const auto n = std::ssize(pairs);
  LandmarkEvaluation result{.names = {},
                            .estimate_m = Points(n, 2),
                            .ground_truth_m = Points(n, 2),
                            .error_m = Eigen::VectorXd(n),
                            .missed = std::ssize(ground_truth.names) - n,
                            .spurious = std::ssize(estimate.names) - n};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& [row, map_row] = pairs[static_cast<std::size_t>(i)];
    result.names.push_back(ground_truth.names[static_cast<std::size_t>(row)]);
    result.ground_truth_m.row(i) = ground_truth.positions_m.row(row);
    result.estimate_m.row(i) = map_m.row(map_row);
    result.error_m(i) = (result.estimate_m.row(i) - result.ground_truth_m.row(i)).norm();
  }
  return result;
}

}  // namespace mapproof
