#include "core/score/map_score.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>

#include <fmt/format.h>

#include "core/align/affine.hpp"
#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/base/vectorised.hpp"
#include "core/linalg/planarity.hpp"

namespace mapproof {
namespace {

/// The sine of an angle that rounding alone may have opened.
constexpr double kStraight = 1e-12;

/// What rounding may have moved a landmark of a map by, as a share of the median distance of
/// landmarks from the origin: one that is far out does not count.
constexpr double kRounding = 1e-12;

/// The points behind one, as seen from it: coordinates apart, so that they fill vectors.
struct Offsets {
  const double* x;
  const double* y;
};

struct Count {
  std::int64_t judged = 0;
  std::int64_t wrong = 0;
};

/// Of the triples that the offset `first` forms with all after it. A triple is flat on the map if
/// its height may be rounding.
/// @param slack  Of each offset of the estimate: its length times what rounding may have moved.
MAPPROOF_VECTORISED Count count_turns(Offsets ground_truth, Offsets estimate, const double* slack,
                                      Eigen::Index first, Eigen::Index count) {
  const double tx = ground_truth.x[first], ty = ground_truth.y[first];
  const double ex = estimate.x[first], ey = estimate.y[first];
  std::int64_t judged = 0;
  std::int64_t wrong = 0;
  for (Eigen::Index k = first + 1; k < count; ++k) {
    const double turn = tx * ground_truth.y[k] - ty * ground_truth.x[k];
    const double found = ex * estimate.y[k] - ey * estimate.x[k];
    const bool counts = std::abs(turn) > kStraight;
    const bool is_flat = !(std::abs(found) > slack[first] + slack[k]);
    const bool right =
        (!is_flat) & (((turn > 0.0) & (found > 0.0)) | ((turn < 0.0) & (found < 0.0)));
    judged += counts;
    wrong += counts & !right;
  }
  return {judged, wrong};
}

/// More landmarks have too many triples for all to be judged.
constexpr Eigen::Index kMostOfAll = 5000;
constexpr int kDrawnTriples = 10'000'000;

/// The same of triples drawn evenly. @param moved  What rounding may have moved a landmark by.
Count count_drawn_turns(const Points& ground_truth, const Points& estimate, double moved) {
  const auto n = static_cast<double>(ground_truth.rows());
  Random random(1);
  Count count;
  for (int k = 0; k < kDrawnTriples; ++k) {
    const auto drawn = [&] { return static_cast<Eigen::Index>(random.uniform() * n); };
    const Eigen::Index i = drawn(), a = drawn(), b = drawn();
    const Eigen::RowVector2d to_a = ground_truth.row(a) - ground_truth.row(i);
    const Eigen::RowVector2d to_b = ground_truth.row(b) - ground_truth.row(i);
    const double turn = (to_a.x() * to_b.y() - to_a.y() * to_b.x()) / (to_a.norm() * to_b.norm());
    if (!(std::abs(turn) > kStraight)) continue;  // Or a landmark was drawn twice.
    const Eigen::RowVector2d ea = estimate.row(a) - estimate.row(i);
    const Eigen::RowVector2d eb = estimate.row(b) - estimate.row(i);
    const double found = ea.x() * eb.y() - ea.y() * eb.x();
    const bool is_flat = !(std::abs(found) > moved * (ea.norm() + eb.norm()));
    ++count.judged;
    if (is_flat || (turn > 0.0) != (found > 0.0)) ++count.wrong;
  }
  return count;
}

double percent_of(const Count& count) {
  if (count.judged == 0) return kNaN;
  return 100.0 * static_cast<double>(count.wrong) / static_cast<double>(count.judged);
}

void check(const Points& estimate, const Points& ground_truth,
           const std::vector<Eigen::Index>& anchors) {
  if (estimate.rows() != ground_truth.rows())
    throw InvalidInput(fmt::format("the map has {} landmarks, the ground truth {}", estimate.rows(),
                                   ground_truth.rows()));
  for (const Eigen::Index anchor : anchors)
    if (anchor < 0 || anchor >= ground_truth.rows())
      throw InvalidInput(
          fmt::format("anchor {} is not among the {} landmarks", anchor, ground_truth.rows()));
}

}  // namespace

double orientation_error_percent(const Points& ground_truth, const Points& estimate) {
  const Eigen::Index n = ground_truth.rows();
  if (estimate.rows() != n) throw InvalidInput("ground truth and estimate differ in size");
  Count count;
  const Eigen::VectorXd distances = estimate.rowwise().norm();
  const double moved =
      n > 0 ? kRounding * median({distances.data(), static_cast<std::size_t>(n)}) : 0.0;
  if (n > kMostOfAll) return percent_of(count_drawn_turns(ground_truth, estimate, moved));
  for (Eigen::Index i = 0; i < n; ++i) {
    // Of length one, so that each turn's value is a sine; NaN where two points coincide.
    const Points t =
        (ground_truth.bottomRows(n - i - 1).rowwise() - ground_truth.row(i)).rowwise().normalized();
    const Points e = estimate.bottomRows(n - i - 1).rowwise() - estimate.row(i);
    const Offsets to_ground_truth{t.col(0).data(), t.col(1).data()};
    const Offsets to_estimate{e.col(0).data(), e.col(1).data()};
    const Eigen::VectorXd slack = moved * e.rowwise().norm();
    for (Eigen::Index j = 0; j < t.rows(); ++j) {
      const Count found = count_turns(to_ground_truth, to_estimate, slack.data(), j, t.rows());
      count.judged += found.judged;
      count.wrong += found.wrong;
    }
  }
  return percent_of(count);
}

AlignedMap align_to_anchors(const Points& coordinates, const Points& anchors_m,
                            const std::vector<Eigen::Index>& anchors, AffineFit fit) {
  check(coordinates, anchors_m, anchors);
  AlignedMap result{.positions_m = coordinates, .statuses = {}};
  std::vector<Eigen::Index> mapped;
  std::ranges::copy_if(anchors, std::back_inserter(mapped),
                       [&](Eigen::Index anchor) { return coordinates.row(anchor).allFinite(); });
  if (mapped.size() < 3) {
    result.statuses.push_back(
        status_of<StatusReason::kFewAnchorsMapped>(mapped.size(), anchors.size()));
    return result;
  }
  const Points from = coordinates(mapped, Eigen::all);
  const Points to = anchors_m(mapped, Eigen::all);
  if (planarity(to) <= kFlatPlanarity) throw InvalidInput("the anchors lie on one line");
  if (planarity(from) <= kFlatPlanarity) {
    result.statuses.push_back(status_of<StatusReason::kAnchorsOnALine>());
    return result;
  }
  result.positions_m = fit_affine(from, to, fit)(coordinates);
  result.aligned = true;
  return result;
}

std::optional<Score> score_map(const Points& estimate_m, const Points& ground_truth_m,
                               const std::vector<Eigen::Index>& anchors, AffineFit fit) {
  check(estimate_m, ground_truth_m, anchors);
  std::vector<Eigen::Index> both;
  for (Eigen::Index i = 0; i < ground_truth_m.rows(); ++i)
    if (estimate_m.row(i).allFinite() && ground_truth_m.row(i).allFinite()) both.push_back(i);
  if (both.size() < 3) return std::nullopt;

  const Points estimate = estimate_m(both, Eigen::all);
  const Points ground_truth = ground_truth_m(both, Eigen::all);
  const Eigen::VectorXd errors = (estimate - ground_truth).rowwise().norm();
  double sum = 0.0;
  int count = 0;
  for (std::size_t row = 0; row < both.size(); ++row)
    if (std::ranges::find(anchors, both[row]) == anchors.end()) {
      sum += errors(static_cast<Eigen::Index>(row));
      ++count;
    }
  const double nan = kNaN;
  Score score;
  score.mpe_m = count > 0 ? sum / count : nan;
  // Some affine map takes any three landmarks to any three positions.
  const bool is_any_map_right = both.size() == 3;
  score.moe_percent =
      is_any_map_right && count == 0 ? nan : orientation_error_percent(ground_truth, estimate);
  // Not 100 less the other: triples that the map flattens are wrong in both orientations.
  const Points mirrored = estimate.rowwise().reverse();
  score.moe_unmirrored_percent =
      is_any_map_right ? nan
      : score.moe_percent > 50.0
          ? std::min(score.moe_percent, orientation_error_percent(ground_truth, mirrored))
          : score.moe_percent;
  score.mpe_all_fitted_m = !is_any_map_right && planarity(estimate) > kFlatPlanarity
                               ? (fit_affine(estimate, ground_truth, fit)(estimate) - ground_truth)
                                     .rowwise()
                                     .norm()
                                     .mean()
                               : nan;
  return score;
}

}  // namespace mapproof
