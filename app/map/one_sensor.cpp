#include "app/map/one_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/map/submaps.hpp"
#include "app/map/uncertainty.hpp"
#include "core/base/errors.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {
namespace {

/// Landmarks with nothing observed of them: an error at the first, or a remark.
void check_unseen(const ObservationSource& source, Eigen::Index steps, const MapOptions& options,
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
                    quoted_name(source.history.names[first]),
                    source.history.sensor == Sensor::kVisibility ? " (no 1 in its row)" : ""));
  remarks.push_back(fmt::format("{} of {} landmarks were never observed and are left out.",
                                unseen.size(), source.history.landmarks()));
}

std::vector<std::pair<std::string, std::string>> facts_of(const ObservationSource& source,
                                                          Eigen::Index steps) {
  const auto missing = static_cast<double>(source.history.values.array().isNaN().count());
  const auto entries = static_cast<double>(source.history.values.size());
  return {{"Landmarks", std::to_string(source.history.landmarks())},
          {"Steps used", fmt::format("{} of {}", steps, source.history.steps())},
          {"Missing entries", fmt::format("{:.1f} %", 100.0 * missing / entries)}};
}

void check_method(const ObservationSource& source, const MapOptions& options) {
  const Eigen::Index M = source.history.landmarks();
  if (M < 3)
    throw IoError(source.path,
                  fmt::format("{} landmark{}; a map needs 3 or more", M, M == 1 ? "" : "s"));
  const double K = options.setting.parameter.value_or(0.0);
  if (on_graph(options.setting.method) && K >= static_cast<double>(M))
    throw IoError(source.path,
                  fmt::format("K = {:g} needs more than {:g} landmarks, {} are there", K, K, M));
}

}  // namespace

void begin_map(const MapOptions& options, const BegunMap& begun, const Reference& reference) {
  if (!options.begin) return;
  MapRecord record;
  record.id = begun.id;
  record.origin = begun.origin;
  record.step = begun.step;
  record.names = begun.names;
  record.anchors = reference.anchors;
  if (reference.has_truth || !reference.anchors.empty()) record.truth_m = reference.positions_m;
  options.begin(record);
}

MapResult map_observations(const ObservationSource& source,
                           const std::optional<NamedPointsFile>& anchors,
                           const std::optional<NamedPointsFile>& truth, const MapOptions& options) {
  const Eigen::Index steps = options.steps > 0 ? options.steps : source.history.steps();
  if (steps > source.history.steps())
    throw IoError(source.path, fmt::format("--steps {}: it holds {} observations", steps,
                                           source.history.steps()));
  check_method(source, options);
  MapResult result{
      .record = {}, .remarks = source.remarks, .joined = {}, .read = facts_of(source, steps)};
  check_unseen(source, steps, options, result.remarks);
  const MappedLandmarks landmarks{.path = source.path,
                                  .names = source.history.names,
                                  .unseen = unseen_landmarks(source.history, steps),
                                  .truth_m = source.truth_m};
  const Reference reference = reference_of(landmarks, anchors, truth, result.remarks);

  begin_map(options,
            {.origin = FromSensor{source.history.sensor, options.setting},
             .step = static_cast<int>(steps),
             .names = source.history.names},
            reference);
  EmbedderOptions fitting;
  fitting.only_seen_together = options.only_seen_together;
  MissingOutcome missing, of_draws;  // What draws of the steps went through is not told.
  const MissingChoice choice = judged_choice(options.missing, source.history, steps, missing);
  MethodSetting asked = options.setting;
  if (options.choose) {
    result.choice = choose_method(source.history, steps, {reference.positions_m, reference.anchors},
                                  {.embedder = fitting,
                                   .rule = proximity_rule(choice, source.history.sensor, of_draws),
                                   .fit = options.fit});
    if (!result.choice->order.empty())
      asked = result.choice->maps[result.choice->order.front()].setting;
  }
  MapEmbedding made = embed_observations(source.history, steps, asked, fitting,
                                         proximity_rule(choice, source.history.sensor, missing),
                                         options.submaps, options.overlap);
  result.remarks.insert(result.remarks.end(), missing.remarks.begin(), missing.remarks.end());
  result.remarks.insert(result.remarks.end(), made.remarks.begin(), made.remarks.end());
  result.warnings = std::move(missing.warnings);
  result.joined = std::move(made.joined);
  const Embedding& embedding = made.embedding;
  MapRecord& record = result.record;
  record.id = "map";
  record.origin = FromSensor{source.history.sensor, made.setting};
  record.step = static_cast<int>(steps);
  record.names = source.history.names;
  record.statuses = std::move(missing.statuses);
  record.statuses.insert(record.statuses.end(), embedding.statuses.begin(),
                         embedding.statuses.end());
  if (missing.completed)
    for (Status& status : record.statuses)
      if (status.code == StatusCode::kDistancesCompleted) status = *missing.completed;
  record.certificate = embedding.certificate;
  align_and_score(record, embedding.coordinates, reference, options.fit);
  if (options.ellipse_replicates > 0)
    result.certainty =
        map_uncertainty(record, source.history,
                        {.setting = made.setting,
                         .embedder = fitting,
                         .rule = proximity_rule(choice, source.history.sensor, of_draws),
                         .replicates = options.ellipse_replicates,
                         .fit = options.fit},
                        result.remarks);
  return result;
}

}  // namespace mapproof
