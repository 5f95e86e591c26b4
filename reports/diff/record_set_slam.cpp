#include <limits>

#include <fmt/format.h>

#include "core/base/files.hpp"
#include "core/records/slam_files.hpp"
#include "core/records/slam_run_json.hpp"
#include "core/records/slam_store.hpp"
#include "reports/diff/record_set_parts.hpp"

namespace mapproof {
namespace {

/// One run a subject's: methods on different logs have no seeds to pair.
constexpr const char* kOnce = "";

void add_record(RecordSet& set, const SlamRun& run, const SlamRecord& record) {
  const std::string id = fmt::format("{}/{}", run.id, info(record.method).name);
  const auto value = [&](std::string_view quantity, double number) {
    add_value(set, id, quantity, kOnce, number);
  };
  for (const TrajectoryError& error : record.errors) {
    if (&error != &record.errors.front()) continue;  // The others follow from the same path.
    value("mean_m", error.mean_m);
    value("rmse_m", error.rmse_m);
    value("last_tenth_m", error.last_tenth_m);
    value("best_tenth_m", error.best_tenth_m);
    value("worst_tenth_m", error.worst_tenth_m);
    if (error.landmarks_m) value("landmarks_m", *error.landmarks_m);
  }
  const SlamEstimate& estimate = record.estimate;
  value("range_scale", estimate.range_scale);
  value("iterations", estimate.iterations);
  if (estimate.cost) value("cost", *estimate.cost);
  add_statuses(set, id, estimate.statuses);
  set.points[id] = {.quantity = "landmark_m",
                    .frame = Frame::kTruth,
                    .names = run.log.landmarks,
                    .points = estimate.landmarks_m,
                    .truth = run.log.true_landmarks};
  set.points[id + "/path"] = {.quantity = "path_m",
                              .frame = Frame::kTruth,
                              .names = {},
                              .points = estimate.path.positions_m,
                              .truth = std::nullopt};
}

void add_convergence(RecordSet& set, const ConvergenceCurve& curve) {
  for (const ConvergencePoint& point : curve.points) {
    const std::string subject = fmt::format("convergence/{}/{}", curve.id, point.steps);
    add_value(set, subject, "observation_error", kOnce, point.observation.mean);
    add_value(set, subject, "landmarks_m", kOnce, point.landmarks_m.mean);
    add_value(set, subject, "positions_m", kOnce, point.positions_m.mean);
    add_value(set, subject, "sine", kOnce, point.sine.mean);
  }
}

void add_histories(RecordSet& set, const RangeHistoryStudy& histories) {
  for (const RangeHistoryMap& map : histories.maps) {
    // As figures name them, but for the parameter: it may follow from the data.
    const std::string place = map.squared ? "histories/squared/" : "histories/range/";
    const std::string subject =
        place + (map.setting ? slug(*map.setting) : std::string("spectral"));
    if (map.setting && map.setting->parameter)
      set.families[subject] = {place + std::string(info(map.setting->method).name),
                               parameter_text(*map.setting)};
    add_score(set, subject, kOnce, map.score);
    add_statuses(set, subject, map.statuses);
    set.points[subject] = {.quantity = "landmark_m",
                           .frame = Frame::kTruth,
                           .names = {},
                           .points = map.positions_m,
                           .truth = histories.landmarks_m};
  }
}

}  // namespace

void add_slam_run(RecordSet& set, const SlamRun& run) {
  set.runs[run.id] = run.id;
  for (const SlamRecord& record : run.records) add_record(set, run, record);
  if (run.log.truth)
    set.worlds[run.id] = {.quantity = "path_m",
                          .frame = Frame::kTruth,
                          .names = {},
                          .points = run.log.truth->positions_m,
                          .truth = std::nullopt};
}

RecordSet read_slam_records(const std::filesystem::path& folder) {
  const SlamStudy study = read_slam_study(folder);
  RecordSet set;
  set.kind = "mapproof.slam_study";
  const std::filesystem::path file = SlamFiles{folder}.study();
  add_settings(set, read_file(file), file.string());
  set.provenance = study.provenance;
  for (const SlamRun& run : study.runs) add_slam_run(set, run);
  for (const ConvergenceCurve& curve : study.convergence) add_convergence(set, curve);
  if (study.histories) add_histories(set, *study.histories);
  return set;
}

}  // namespace mapproof
