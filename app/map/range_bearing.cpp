#include "app/map/range_bearing.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "app/map/uncertainty.hpp"
#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "core/observe/detected_proximities.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/score/map_score.hpp"

namespace mapproof {
namespace {

/// Leaves the first so many scans, and returns how many there were.
int keep_first(DetectionSource& source, int steps) {
  DetectionLog& log = source.log;
  const int all = log.steps;
  if (steps > log.steps)
    throw IoError(source.path,
                  fmt::format("--steps {}: it holds {} observations", steps, log.steps));
  if (steps == 0) return all;
  std::erase_if(log.detections, [&](const Detection& seen) { return seen.step >= steps; });
  log.steps = steps;
  return all;
}

void require_three(const DetectionSource& source) {
  const auto M = std::ssize(source.log.names);
  if (M < 3)
    throw IoError(source.path, fmt::format("{}; a map needs 3 or more", counted(M, "landmark")));
}

/// @param scans  That there were.
MapResult begun(const DetectionSource& source, int scans) {
  const DetectionLog& log = source.log;
  MapResult result{.record = {}, .remarks = source.remarks, .joined = {}, .read = {}};
  result.record.id = "map";
  result.record.step = log.steps;
  result.record.names = log.names;
  result.read = {{"Landmarks", std::to_string(log.names.size())},
                 {"Steps used", fmt::format("{} of {}", log.steps, scans)},
                 {"Detections", std::to_string(log.detections.size())}};
  return result;
}

Reference known_places(const DetectionSource& source, const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& truth, MapResult& result) {
  return reference_of({.path = source.path,
                       .names = source.log.names,
                       .unseen = unseen_in(source.log),
                       .truth_m = source.truth_m},
                      anchors, truth, result.remarks);
}

/// Turns, shifts and perhaps mirrors the map onto those of the rows that it holds.
bool lay_rigidly(MapRecord& record, const Points& known_m, const std::vector<Eigen::Index>& rows) {
  std::vector<Eigen::Index> both;
  for (const Eigen::Index row : rows)
    if (record.estimate.row(row).allFinite() && known_m.row(row).allFinite()) both.push_back(row);
  if (both.size() < 3) {
    record.statuses.push_back(status_of<StatusReason::kFewKnownMapped>(both.size()));
    return false;
  }
  record.estimate = fit_similarity(record.estimate(both, Eigen::all), known_m(both, Eigen::all),
                                   Alignment::kRigidWithReflection)(record.estimate);
  return true;
}

}  // namespace

CertaintyFrame place_pairs(MapResult& result, const Reference& known, AffineFit fit, bool rigid) {
  MapRecord& record = result.record;
  const Points own = record.estimate;
  if (!rigid && !known.anchors.empty()) align_and_score(record, own, known, fit);
  if (record.frame == Frame::kTruth && !rigid && !known.anchors.empty())
    return {known.positions_m, known.anchors, false};
  record.frame = Frame::kTruth;
  record.anchors = known.anchors;
  if (known.anchors.empty() && !known.has_truth) return {own, {}, true};
  std::vector<Eigen::Index> all(record.names.size());
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  if (!lay_rigidly(record, known.positions_m, known.anchors.empty() ? all : known.anchors))
    return {own, {}, true};
  record.truth_m = known.positions_m;
  if (known.anchors.empty())
    result.remarks.push_back(
        "No anchors: for its errors the map was turned and shifted onto the truth, its scale "
        "kept.");
  if (known.has_truth)
    record.score = score_map(record.estimate, known.positions_m, known.anchors, fit);
  if (known.anchors.empty()) return {record.estimate, {}, true};
  return {known.positions_m, known.anchors, true};
}

void describe_pairs(MapResult& result, const PairMap& map) {
  MapRecord& record = result.record;
  const std::size_t M = record.names.size();
  record.origin = FromPairs{};
  record.estimate = map.embedding.coordinates;
  record.statuses = map.embedding.statuses;
  result.read.emplace_back("Measured pairs",
                           fmt::format("{} of {}", map.pairs.size(), M * (M - 1) / 2));
}

MapResult map_pairs(DetectionSource source, const std::optional<NamedPointsFile>& anchors,
                    const std::optional<NamedPointsFile>& truth, const MapOptions& options,
                    bool rigid) {
  require_three(source);
  const int scans = keep_first(source, options.steps);
  const DetectionLog& log = source.log;
  MapResult result = begun(source, scans);
  const Reference known = known_places(source, anchors, truth, result);
  const PairMap map = pair_map_of(log);
  MapRecord& record = result.record;
  describe_pairs(result, map);
  const CertaintyFrame frame = place_pairs(result, known, options.fit, rigid);
  if (options.ellipse_replicates > 0)
    result.certainty = pair_map_uncertainty(
        record, log, frame, {.replicates = options.ellipse_replicates, .fit = options.fit},
        result.remarks);
  return result;
}

MapResult map_sparse(DetectionSource source, Sensor sensor,
                     const std::optional<NamedPointsFile>& anchors,
                     const std::optional<NamedPointsFile>& truth, const MapOptions& options) {
  require_three(source);
  const int scans = keep_first(source, options.steps);
  const DetectionLog& log = source.log;
  MapResult result = begun(source, scans);
  const Reference known = known_places(source, anchors, truth, result);
  if (const std::vector<Eigen::Index> unseen = unseen_in(log); !unseen.empty())
    throw IoError(source.path, fmt::format("{} of {} landmarks are not in the first {} scans",
                                           unseen.size(), log.names.size(), log.steps));
  EmbedderOptions fitting;
  fitting.only_seen_together = options.only_seen_together;
  begin_map(options,
            {.origin = FromSensor{sensor, options.setting}, .step = log.steps, .names = log.names},
            known);
  Embedder embedder(detected_proximities(log, sensor), fitting);
  MapRecord& record = result.record;
  const MethodSetting setting =
      options.setting.parameter ? options.setting : embedder.usual_setting(options.setting.method);
  record.origin = FromSensor{sensor, setting};
  const Embedding embedding = embedder.embed(setting);
  record.statuses = embedding.statuses;
  record.certificate = embedding.certificate;
  align_and_score(record, embedding.coordinates, known, options.fit);
  return result;
}

}  // namespace mapproof
