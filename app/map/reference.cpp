#include "app/map/reference.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/align/diagonal_anchors.hpp"
#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/words.hpp"
#include "core/linalg/planarity.hpp"
#include "core/score/map_score.hpp"

namespace mapproof {
namespace {

constexpr double kFarOut = 2.0;  ///< The median landmark so many times as far out as any anchor.

/// The row of each landmark by its name.
std::map<std::string, Eigen::Index> rows_of(const MappedLandmarks& source) {
  std::map<std::string, Eigen::Index> rows;
  for (std::size_t i = 0; i < source.names.size(); ++i)
    rows[source.names[i]] = static_cast<Eigen::Index>(i);
  return rows;
}

/// Positions by landmark, in the rows of the source; NaN where the file has none.
Points matched_truth(const MappedLandmarks& source, const NamedPointsFile& truth,
                     std::vector<std::string>& remarks) {
  const auto rows = rows_of(source);
  Points positions = Points::Constant(source.landmarks(), 2, kNaN);
  Eigen::Index matched = 0;
  for (std::size_t i = 0; i < truth.points.names.size(); ++i) {
    const auto row = rows.find(truth.points.names[i]);
    if (row == rows.end()) continue;
    positions.row(row->second) = truth.points.positions_m.row(static_cast<Eigen::Index>(i));
    ++matched;
  }
  const auto given = std::ssize(truth.points.names);
  if (matched == 0)
    throw IoError(truth.path, fmt::format("none of its {} names is a landmark of {} ({}, ...)",
                                          given, source.path, quoted_name(source.names.at(0))));
  if (matched < given)
    remarks.push_back(fmt::format(
        "True positions of landmarks that were not observed, not used: {}.", given - matched));
  if (matched < source.landmarks())
    remarks.push_back(fmt::format("The true position of {} is not known.",
                                  counted(source.landmarks() - matched, "landmark")));
  return positions;
}

/// The anchors' rows, ascending; their positions go into `positions`.
std::vector<Eigen::Index> matched_anchors(const MappedLandmarks& source,
                                          const NamedPointsFile& anchors, Points& positions) {
  const auto rows = rows_of(source);
  std::vector<Eigen::Index> chosen;
  for (std::size_t i = 0; i < anchors.points.names.size(); ++i) {
    const std::string& name = anchors.points.names[i];
    const auto row = rows.find(name);
    if (row == rows.end())
      throw IoError(
          anchors.path, anchors.points.places[i],
          fmt::format("anchor {} is not among the {} landmarks of {} ({}, ...)", quoted_name(name),
                      source.landmarks(), source.path, quoted_name(source.names.at(0))));
    if (std::ranges::binary_search(source.unseen, row->second)) continue;
    positions.row(row->second) = anchors.points.positions_m.row(static_cast<Eigen::Index>(i));
    chosen.push_back(row->second);
  }
  if (chosen.size() < 3)
    throw IoError(anchors.path,
                  fmt::format("{} observed anchor{}; an affine map to the anchors needs 3 or more",
                              chosen.size(), chosen.size() == 1 ? "" : "s"));
  if (planarity(positions(chosen, Eigen::all)) <= kFlatPlanarity)
    throw IoError(
        anchors.path,
        fmt::format("its {} anchors lie on one line; they must span the plane", chosen.size()));
  std::ranges::sort(chosen);
  return chosen;
}

/// Errors of a map that no anchors tie to the truth: those that need none.
std::optional<Score> anchor_free_score(const Points& coordinates, const Points& truth_m,
                                       AffineFit fit) {
  std::optional<Score> score = score_map(coordinates, truth_m, {}, fit);
  if (score) score->mpe_m = score->moe_percent = kNaN;
  return score;
}

/// The anchors of a source that brings its truth, chosen among the landmarks that were observed;
/// none, with a remark, if they lie on one line.
std::vector<Eigen::Index> diagonal_anchors_of(const MappedLandmarks& source, Points positions_m,
                                              std::vector<std::string>& remarks) {
  for (const Eigen::Index row : source.unseen) positions_m.row(row).setConstant(kNaN);
  std::vector<Eigen::Index> anchors = diagonal_anchors(positions_m);
  if (planarity(positions_m(anchors, Eigen::all)) > kFlatPlanarity) return anchors;
  remarks.emplace_back("The observed landmarks lie on one line: none of them can be an anchor.");
  return {};
}

/// Anchors that stand elsewhere in the truth than in their own file.
void remark_disagreement(const Points& truth_m, const Reference& known,
                         std::vector<std::string>& remarks) {
  const auto moved = std::ranges::count_if(known.anchors, [&](Eigen::Index row) {
    return (truth_m.row(row) - known.positions_m.row(row)).norm() > 1e-6;
  });
  if (moved > 0)
    remarks.push_back(
        fmt::format("Anchors that the truth puts elsewhere: {}. The anchors' own "
                    "positions are used.",
                    moved));
}

}  // namespace

std::optional<NamedPointsFile> read_points(const std::string& path) {
  if (path.empty()) return std::nullopt;
  return NamedPointsFile{.path = input_name(path), .points = read_landmarks(path)};
}

std::string quoted_name(const std::string& name) { return "\"" + printable(name) + "\""; }

Reference reference_of(const MappedLandmarks& source, const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& truth,
                       std::vector<std::string>& remarks) {
  Reference known{.positions_m = Points::Constant(source.landmarks(), 2, kNaN),
                  .has_truth = truth.has_value() || source.truth_m.has_value(),
                  .anchors = {}};
  if (truth) {
    known.positions_m = matched_truth(source, *truth, remarks);
  } else if (source.truth_m) {
    known.positions_m = *source.truth_m;
  }
  if (anchors) {
    const Points truth_m = known.positions_m;
    known.anchors = matched_anchors(source, *anchors, known.positions_m);
    remark_disagreement(truth_m, known, remarks);
  } else if (source.truth_m) {
    known.anchors = diagonal_anchors_of(source, known.positions_m, remarks);
  }
  return known;
}

void align_and_score(MapRecord& record, const Points& coordinates, const Reference& reference,
                     AffineFit fit) {
  record.frame = Frame::kSimilarity;
  record.estimate = coordinates;
  record.anchors = reference.anchors;
  if (reference.has_truth || !reference.anchors.empty()) record.truth_m = reference.positions_m;
  if (!reference.anchors.empty()) {
    AlignedMap aligned =
        align_to_anchors(coordinates, reference.positions_m, reference.anchors, fit);
    record.statuses.insert(record.statuses.end(), aligned.statuses.begin(), aligned.statuses.end());
    if (aligned.aligned) {
      record.frame = Frame::kTruth;
      record.estimate = std::move(aligned.positions_m);
    }
  }
  if (!reference.has_truth) return;
  record.score = record.frame == Frame::kTruth
                     ? score_map(record.estimate, reference.positions_m, reference.anchors, fit)
                     : anchor_free_score(record.estimate, reference.positions_m, fit);
}

std::vector<std::string> frame_warnings(const MapRecord& record) {
  if (record.frame != Frame::kTruth || record.anchors.empty() || !record.truth_m) return {};
  const Points anchors_m = (*record.truth_m)(record.anchors, Eigen::all);
  const Eigen::RowVector2d centre = anchors_m.colwise().mean();
  std::vector<double> away;
  double trivial_m = 0.0;
  int known = 0;
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i) {
    if (!record.estimate.row(i).allFinite() || std::ranges::count(record.anchors, i) > 0) continue;
    away.push_back((record.estimate.row(i) - centre).norm());
    if (!record.truth_m->row(i).allFinite()) continue;
    trivial_m += (record.truth_m->row(i) - centre).norm();
    ++known;
  }
  if (away.empty()) return {};
  if (record.score && known > 0 && std::isfinite(record.score->mpe_m)) {
    trivial_m /= known;
    if (record.score->mpe_m < trivial_m) return {};
    return {
        fmt::format("The map is worth nothing in metres: its MPE is {:.3g} m, and all landmarks "
                    "put at the mean "
                    "of the anchors would have one of {:.3g} m.",
                    record.score->mpe_m, trivial_m)};
  }
  const double reach_m = (anchors_m.rowwise() - centre).rowwise().norm().maxCoeff();
  const auto middle = away.begin() + std::ssize(away) / 2;
  std::ranges::nth_element(away, middle);
  if (*middle < kFarOut * reach_m) return {};
  return {fmt::format(
      "Half of the landmarks lie {:.3g} m or more from the anchors' mean, no anchor beyond {:.3g} "
      "m: the map, or its fit to the anchors, is likely to be worth nothing.",
      *middle, reach_m)};
}

}  // namespace mapproof
