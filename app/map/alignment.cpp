#include "app/map/alignment.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/align/rigid.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/map_fit/map_fit.hpp"
#include "core/score/map_score.hpp"

namespace mapproof {
namespace {

/// Of the anchors' spread: as much as of known positions in sound worlds, in which some methods are
/// far off (docs/methods/map-fit.md).
constexpr double kMostAnchorMiss = kMostKnownShare;
constexpr double kFarOut = 2.0;  ///< The median landmark so many times as far out as any anchor.

/// Errors of a map without anchors: those that need none.
std::optional<Score> anchor_free_score(const Points& coordinates, const Points& ground_truth_m,
                                       AffineFit fit) {
  std::optional<Score> score = score_map(coordinates, ground_truth_m, {}, fit);
  if (score) score->mpe_m = score->moe_percent = kNaN;
  return score;
}

/// Rotates, translates and perhaps reflects the map onto those of the rows that it holds.
/// @return The motion; empty if there are too few of them.
std::optional<Similarity> align_rigidly(MapRecord& record, const Points& known_m,
                                        const std::vector<Eigen::Index>& rows) {
  std::vector<Eigen::Index> both;
  for (const Eigen::Index row : rows)
    if (record.estimate.row(row).allFinite() && known_m.row(row).allFinite()) both.push_back(row);
  if (both.size() < 3) {
    record.statuses.push_back(status_of<StatusReason::kFewKnownMapped>(both.size()));
    return std::nullopt;
  }
  Similarity motion = fit_similarity(record.estimate(both, Eigen::all), known_m(both, Eigen::all),
                                     Alignment::kRigidWithReflection);
  record.estimate = motion(record.estimate);
  return motion;
}

/// Of a map in metres.
UncertaintyFrame align_metric(MapResult& result, const Reference& known, const FrameFit& fit) {
  const bool rigid = fit.is_rigid;
  MapRecord& record = result.record;
  const Points own = record.estimate;
  if (!rigid && !known.anchors.empty()) align_and_score(record, own, known, fit.affine);
  if (record.frame == Frame::kGroundTruth && !rigid && !known.anchors.empty())
    return {known.positions_m, known.anchors, false};
  record.frame = Frame::kGroundTruth;
  record.anchors = known.anchors;
  if (known.anchors.empty() && !known.has_ground_truth) return {own, {}, true};
  std::vector<Eigen::Index> all(record.names.size());
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  const std::optional<Similarity> motion =
      align_rigidly(record, known.positions_m, known.anchors.empty() ? all : known.anchors);
  if (!motion) return {own, {}, true};
  record.ground_truth_m = known.positions_m;
  if (known.anchors.empty())
    result.remarks.push_back(fmt::format(
        "No anchors: for its errors the map was {}rotated and translated onto the ground truth, "
        "and keeps its scale.",
        motion->rotation.determinant() < 0.0 ? "reflected, " : ""));
  if (known.has_ground_truth)
    record.score = score_map(record.estimate, known.positions_m, known.anchors, fit.affine);
  if (known.anchors.empty()) return {record.estimate, {}, true};
  return {known.positions_m, known.anchors, true};
}

}  // namespace

UncertaintyFrame align(MapResult& result, const Reference& reference, const FrameFit& fit) {
  if (fit.is_metric) return align_metric(result, reference, fit);
  MapRecord& record = result.record;
  align_and_score(record, Points(record.estimate), reference, fit.affine);
  const bool tied = record.frame == Frame::kGroundTruth;
  return {.positions_m = tied ? *record.ground_truth_m : record.estimate,
          .anchors = tied ? record.anchors : std::vector<Eigen::Index>{}};
}

void align_and_score(MapRecord& record, const Points& coordinates, const Reference& reference,
                     AffineFit fit) {
  record.frame = Frame::kSimilarity;
  record.estimate = coordinates;
  record.anchors = reference.anchors;
  if (reference.has_ground_truth || !reference.anchors.empty())
    record.ground_truth_m = reference.positions_m;
  if (!reference.anchors.empty()) {
    AlignedMap aligned =
        align_to_anchors(coordinates, reference.positions_m, reference.anchors, fit);
    record.statuses.insert(record.statuses.end(), aligned.statuses.begin(), aligned.statuses.end());
    if (aligned.aligned) {
      record.frame = Frame::kGroundTruth;
      record.estimate = std::move(aligned.positions_m);
    }
  }
  if (!reference.has_ground_truth) return;
  record.score = record.frame == Frame::kGroundTruth
                     ? score_map(record.estimate, reference.positions_m, reference.anchors, fit)
                     : anchor_free_score(record.estimate, reference.positions_m, fit);
}

namespace {

constexpr std::size_t kFewestAnchors = 4;    ///< Three are met by any map.
constexpr std::size_t kFewestToNameOne = 6;  ///< Else another one may be the wrong one.
constexpr double kSureMiss = 2.0;            ///< Times the bound: more than doubtful.

/// The greatest miss of an anchor, of their spread.
void check_anchors(const MapRecord& record, FrameCheck& check) {
  if (record.anchors.size() < kFewestAnchors || std::holds_alternative<FromPairs>(record.origin) ||
      std::holds_alternative<FromRanges>(record.origin))
    return;
  const Points anchors_m = (*record.ground_truth_m)(record.anchors, Eigen::all);
  const Points offsets_m = anchors_m.rowwise() - anchors_m.colwise().mean();
  const double spread_m =
      std::sqrt(offsets_m.squaredNorm() / static_cast<double>(offsets_m.rows()));
  const Points mapped_m = record.estimate(record.anchors, Eigen::all);
  if (!mapped_m.allFinite() || !(spread_m > 0.0)) return;
  Eigen::Index worst = 0;
  const double miss_m = (mapped_m - anchors_m).rowwise().norm().maxCoeff(&worst);
  const bool is_one = record.anchors.size() >= kFewestToNameOne;
  FitCause cause{.code = is_one ? FitCode::kAnchorMissed : FitCode::kKnownLandmarksAtOdds,
                 .values = {{"distance_m", miss_m}},
                 .statistic = miss_m / spread_m,
                 .bound = kMostAnchorMiss};
  cause.is_small = cause.statistic < kSureMiss * cause.bound;
  const std::vector<Eigen::Index> named =
      is_one ? std::vector{record.anchors[static_cast<std::size_t>(worst)]} : record.anchors;
  for (const Eigen::Index row : named)
    cause.landmarks.push_back(record.names[static_cast<std::size_t>(row)]);
  check.tests.push_back(std::move(cause));
}

}  // namespace

FrameCheck check_frame(const MapRecord& record) {
  FrameCheck check;
  if (record.frame != Frame::kGroundTruth || record.anchors.empty() || !record.ground_truth_m)
    return check;
  check_anchors(record, check);
  const Points anchors_m = (*record.ground_truth_m)(record.anchors, Eigen::all);
  const Eigen::RowVector2d centre = anchors_m.colwise().mean();
  std::vector<double> away;
  double trivial_m = 0.0;
  int known = 0;
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i) {
    if (!record.estimate.row(i).allFinite() || std::ranges::count(record.anchors, i) > 0) continue;
    away.push_back((record.estimate.row(i) - centre).norm());
    if (!record.ground_truth_m->row(i).allFinite()) continue;
    trivial_m += (record.ground_truth_m->row(i) - centre).norm();
    ++known;
  }
  if (away.empty()) return check;
  if (record.score && known > 0 && std::isfinite(record.score->mpe_m)) {
    trivial_m /= known;
    const double mpe_m = record.score->mpe_m;
    if (!(trivial_m > 0.0)) return check;
    check.tests.push_back({.code = FitCode::kAnchorMissed,
                           .values = {{"distance_m", mpe_m}},
                           .statistic = mpe_m / trivial_m,
                           .bound = 1.0});
    if (mpe_m >= trivial_m)
      check.warnings.push_back(fmt::format(
          "The map cannot be used in metres: its MPE is {:.3g} m; a map with all landmarks "
          "at the mean of the anchors would have an MPE of {:.3g} m.",
          mpe_m, trivial_m));
    return check;
  }
  const double reach_m = (anchors_m.rowwise() - centre).rowwise().norm().maxCoeff();
  const double middle_m = upper_median(away);
  if (!(reach_m > 0.0)) return check;
  check.tests.push_back({.code = FitCode::kAnchorMissed,
                         .values = {{"distance_m", middle_m}, {"ratio", middle_m / reach_m}},
                         .statistic = middle_m / reach_m,
                         .bound = kFarOut,
                         .is_small = true});
  if (middle_m >= kFarOut * reach_m)
    check.warnings.push_back(fmt::format(
        "Half of the landmarks lie {:.3g} m or more from the mean of the anchors, but no anchor "
        "beyond {:.3g} m: the map, or its fit to the anchors, is likely to be wrong.",
        middle_m, reach_m));
  return check;
}

}  // namespace mapproof
