#include "app/own_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/own_submaps.hpp"
#include "core/align/affine.hpp"
#include "core/align/diagonal_anchors.hpp"
#include "core/base/errors.hpp"
#include "core/observe/proximities.hpp"
#include "core/score/map_score.hpp"

namespace mapproof {
namespace {

constexpr double kFlat = 1e-6;  ///< Anchors flatter than this do not span the plane.
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

std::string quoted(const std::string& name) { return "\"" + printable(name) + "\""; }

/// The row of each landmark by its name.
std::map<std::string, Eigen::Index> rows_of(const ObservationSource& source) {
  std::map<std::string, Eigen::Index> rows;
  for (std::size_t i = 0; i < source.history.names.size(); ++i)
    rows[source.history.names[i]] = static_cast<Eigen::Index>(i);
  return rows;
}

/// Landmarks with nothing observed of them: an error at the first, or a remark.
void check_unseen(const ObservationSource& source, Eigen::Index steps, const OwnMapOptions& options,
                  std::vector<std::string>& remarks) {
  const std::vector<Eigen::Index> unseen = unseen_landmarks(source.history, steps);
  if (unseen.empty()) return;
  const auto first = static_cast<std::size_t>(unseen.front());
  const bool is_log = source.truth_m.has_value();
  if (!options.drop_unseen && !is_log)
    throw IoError(
        source.path, source.places[first],
        fmt::format("landmark {} is never observed{}; remove it, or pass --drop-unseen "
                    "to map the others",
                    quoted(source.history.names[first]),
                    source.history.sensor == Sensor::kVisibility ? " (no 1 in its row)" : ""));
  remarks.push_back(fmt::format("{} of {} landmarks were never observed and are left out.",
                                unseen.size(), source.history.landmarks()));
}

/// Positions by landmark, in the rows of the source; NaN where the file has none.
Points matched_truth(const ObservationSource& source, const NamedPointsFile& truth,
                     std::vector<std::string>& remarks) {
  const auto rows = rows_of(source);
  Points positions = Points::Constant(source.history.landmarks(), 2, kUnknown);
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
                                          given, source.path, quoted(source.history.names.at(0))));
  if (matched < given)
    remarks.push_back(
        fmt::format("{} positions of the truth are of landmarks that were not "
                    "observed; they are not used.",
                    given - matched));
  if (matched < source.history.landmarks())
    remarks.push_back(fmt::format("The true position of {} landmarks is not known.",
                                  source.history.landmarks() - matched));
  return positions;
}

/// The anchors' rows, ascending; their positions go into `positions`.
std::vector<Eigen::Index> matched_anchors(const ObservationSource& source,
                                          const NamedPointsFile& anchors, Eigen::Index steps,
                                          Points& positions) {
  const auto rows = rows_of(source);
  const std::vector<Eigen::Index> unseen = unseen_landmarks(source.history, steps);
  std::vector<Eigen::Index> chosen;
  for (std::size_t i = 0; i < anchors.points.names.size(); ++i) {
    const std::string& name = anchors.points.names[i];
    const auto row = rows.find(name);
    if (row == rows.end())
      throw IoError(
          anchors.path, anchors.points.places[i],
          fmt::format("anchor {} is not among the {} landmarks of {} ({}, ...)", quoted(name),
                      source.history.landmarks(), source.path, quoted(source.history.names.at(0))));
    if (std::ranges::binary_search(unseen, row->second)) continue;
    positions.row(row->second) = anchors.points.positions_m.row(static_cast<Eigen::Index>(i));
    chosen.push_back(row->second);
  }
  if (chosen.size() < 3)
    throw IoError(anchors.path,
                  fmt::format("{} observed anchor{}; an affine map to the anchors needs 3 or more",
                              chosen.size(), chosen.size() == 1 ? "" : "s"));
  if (planarity(positions(chosen, Eigen::all)) <= kFlat)
    throw IoError(
        anchors.path,
        fmt::format("its {} anchors lie on one line; they must span the plane", chosen.size()));
  std::ranges::sort(chosen);
  return chosen;
}

void check_method(const ObservationSource& source, const OwnMapOptions& options) {
  const Eigen::Index M = source.history.landmarks();
  if (M < 3)
    throw IoError(source.path,
                  fmt::format("{} landmark{}; a map needs 3 or more", M, M == 1 ? "" : "s"));
  const double K = options.setting.parameter.value_or(0.0);
  if (on_graph(options.setting.method) && K >= static_cast<double>(M))
    throw IoError(source.path,
                  fmt::format("K = {:g} needs more than {:g} landmarks, {} are there", K, K, M));
}

/// Errors of a map that no anchors tie to the truth: those that need none.
std::optional<Score> anchor_free_score(const Points& coordinates, const Points& truth_m,
                                       AffineFit fit) {
  std::optional<Score> score = score_map(coordinates, truth_m, {}, fit);
  if (score) score->mpe_m = score->moe_percent = kUnknown;
  return score;
}

/// The anchors of a source that brings its truth, chosen among the landmarks that were observed;
/// none, with a remark, if they lie on one line.
std::vector<Eigen::Index> own_anchors(const ObservationSource& source, Eigen::Index steps,
                                      Points positions_m, std::vector<std::string>& remarks) {
  for (const Eigen::Index row : unseen_landmarks(source.history, steps))
    positions_m.row(row).setConstant(kUnknown);
  std::vector<Eigen::Index> anchors = diagonal_anchors(positions_m);
  if (planarity(positions_m(anchors, Eigen::all)) > kFlat) return anchors;
  remarks.emplace_back("The observed landmarks lie on one line: none of them can be an anchor.");
  return {};
}

/// What is known of the landmarks' true positions.
struct Reference {
  Points positions_m;                 ///< M x 2; NaN rows: unknown.
  bool has_truth = false;             ///< More than the anchors is known: errors can be told.
  std::vector<Eigen::Index> anchors;  ///< Ascending; empty: the map stays a shape.
};

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

Reference reference_of(const ObservationSource& source,
                       const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& truth, Eigen::Index steps,
                       std::vector<std::string>& remarks) {
  Reference known{.positions_m = Points::Constant(source.history.landmarks(), 2, kUnknown),
                  .has_truth = truth.has_value() || source.truth_m.has_value(),
                  .anchors = {}};
  if (truth) {
    known.positions_m = matched_truth(source, *truth, remarks);
  } else if (source.truth_m) {
    known.positions_m = *source.truth_m;
  }
  if (anchors) {
    const Points truth_m = known.positions_m;
    known.anchors = matched_anchors(source, *anchors, steps, known.positions_m);
    remark_disagreement(truth_m, known, remarks);
  } else if (source.truth_m) {
    known.anchors = own_anchors(source, steps, known.positions_m, remarks);
  }
  return known;
}

/// Brings the coordinates into the frame of the anchors, if there are any that serve, and judges
/// them by the truth, if there is one.
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

}  // namespace

OwnMap map_own(const ObservationSource& source, const std::optional<NamedPointsFile>& anchors,
               const std::optional<NamedPointsFile>& truth, const OwnMapOptions& options) {
  const Eigen::Index steps = options.steps > 0 ? options.steps : source.history.steps();
  if (steps > source.history.steps())
    throw IoError(source.path, fmt::format("--steps {}: it holds {} observations", steps,
                                           source.history.steps()));
  check_method(source, options);
  OwnMap result{.record = {}, .remarks = source.remarks, .joined = {}};
  check_unseen(source, steps, options, result.remarks);
  const Reference reference = reference_of(source, anchors, truth, steps, result.remarks);

  EmbedderOptions fitting;
  fitting.only_seen_together = options.only_seen_together;
  MissingOutcome missing;
  OwnEmbedding made = own_embedding(source.history, steps, options.setting, fitting,
                                    proximity_rule(options.missing, source.history.sensor, missing),
                                    options.submaps);
  result.remarks.insert(result.remarks.end(), missing.remarks.begin(), missing.remarks.end());
  result.remarks.insert(result.remarks.end(), made.remarks.begin(), made.remarks.end());
  result.joined = std::move(made.joined);
  const Embedding& embedding = made.embedding;
  MapRecord& record = result.record;
  record.id = "map";
  record.sensor = source.history.sensor;
  record.setting = made.setting;
  record.step = static_cast<int>(steps);
  record.names = source.history.names;
  record.statuses = std::move(missing.statuses);
  record.statuses.insert(record.statuses.end(), embedding.statuses.begin(),
                         embedding.statuses.end());
  record.certificate = embedding.certificate;
  align_and_score(record, embedding.coordinates, reference, options.fit);
  return result;
}

}  // namespace mapproof
