#include "reports/history/night_scores.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/files.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/sha256.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"
#include "core/records/experiment_json.hpp"
#include "core/records/slam_store.hpp"
#include "core/records/study_store.hpp"
#include "core/records/trial_store.hpp"

namespace mapproof {
namespace {

std::string unit_of(const RunId& run) { return fmt::format("layout-{}", run.layout); }

/// Adds the four numbers of a map's score.
void add_score(Scores& scores, SeriesId series, const std::string& run, const std::string& unit,
               const std::optional<Score>& score) {
  const auto add = [&](const char* quantity, double Score::*field) {
    series.quantity = quantity;
    scores[series].push_back({run, unit, score ? (*score).*field : kNaN});
  };
  add("mpe_m", &Score::mpe_m);
  add("moe_percent", &Score::moe_percent);
  add("mpe_all_fitted_m", &Score::mpe_all_fitted_m);
  add("moe_unmirrored_percent", &Score::moe_unmirrored_percent);
}

void add_run(Scores& scores, const Study& study, const Run& run) {
  const std::string id = slug(run.id);
  for (const RunRecord& record : run.records)
    add_score(scores, {std::string(name(record.sensor)), slug(record.setting), record.step, ""}, id,
              unit_of(run.id), record.score);
  for (const VariationRecord& record : run.variations) {
    const auto found =
        std::ranges::find(study.experiment.variations, record.variation, &Variation::id);
    if (found == study.experiment.variations.end()) continue;
    add_score(scores,
              {std::string(name(found->sensor)),
               fmt::format("{} {}={}", slug(record.setting), record.variation, record.level),
               found->step, ""},
              id, unit_of(run.id), record.score);
  }
}

void add_value(Scores& scores, SeriesId series, const std::string& run, double value) {
  scores[std::move(series)].push_back({run, run, value});
}

void add_log(Scores& scores, const SlamRun& run) {
  const std::string kind = run.simulated ? "simulation" : "log";
  for (const SlamRecord& record : run.records) {
    const std::string method(info(record.method).name);
    const TrajectoryError* error = record.errors.empty() ? nullptr : &record.errors.front();
    add_value(scores, {kind, method, 0, "path_mean_m"}, run.id,
              error != nullptr ? error->mean_m : kNaN);
    add_value(scores, {kind, method, 0, "path_rmse_m"}, run.id,
              error != nullptr ? error->rmse_m : kNaN);
    add_value(scores, {kind, method, 0, "landmarks_m"}, run.id,
              error != nullptr ? error->landmarks_m.value_or(kNaN) : kNaN);
  }
}

void add_convergence(Scores& scores, const ConvergenceCurve& curve) {
  for (const ConvergencePoint& point : curve.points) {
    const SeriesId series{"convergence", "spectral-known", point.steps, ""};
    const auto add = [&](const char* quantity, const MeanEstimate& estimate) {
      SeriesId full = series;
      full.quantity = quantity;
      add_value(scores, std::move(full), curve.id, estimate.mean);
    };
    add("observation", point.observation);
    add("landmarks_m", point.landmarks_m);
    add("positions_m", point.positions_m);
  }
}

template <typename Value>
void sort_runs(std::map<SeriesId, std::vector<Value>>& scores) {
  for (auto& [series, values] : scores) std::ranges::sort(values, {}, &Value::run);
}

void add_sessions(StudyNight& night, const std::vector<Session>& sessions) {
  for (const Session& session : sessions) {
    night.seconds = night.seconds.value_or(0.0) + session.seconds;
    if (session.peak_memory_mib)
      night.peak_memory_mib =
          std::max(night.peak_memory_mib.value_or(0.0), *session.peak_memory_mib);
  }
}

}  // namespace

Scores night_scores(const Study& study, std::span<const Timing> timings) {
  Scores scores;
  for (const Run& run : study.runs) add_run(scores, study, run);
  for (const Timing& timing : timings)
    scores[{std::string(name(timing.sensor)), slug(timing.setting), timing.step, "seconds"}]
        .push_back({slug(timing.run), unit_of(timing.run), timing.seconds});
  sort_runs(scores);
  return scores;
}

Scores night_scores(const SlamStudy& study, const SlamTimings& timings) {
  Scores scores;
  for (const SlamRun& run : study.runs) add_log(scores, run);
  for (const ConvergenceCurve& curve : study.convergence) add_convergence(scores, curve);
  if (study.histories)
    for (const RangeHistoryMap& map : study.histories->maps)
      add_score(scores,
                {map.squared ? "squared ranges" : "ranges",
                 map.setting ? slug(*map.setting) : "spectral", study.histories->steps, ""},
                "histories", "histories", map.score);
  for (const SlamTiming& timing : timings.methods)
    add_value(scores, {"range-only", std::string(info(timing.method).name), 0, "seconds"},
              timing.run, timing.seconds);
  for (const FactorizationCost& cost : timings.factorization)
    add_value(
        scores,
        {"range-only", fmt::format("factorization-of-{}", cost.landmarks),
         static_cast<int>(std::min<long>(cost.steps, std::numeric_limits<int>::max())), "seconds"},
        "factorization", cost.seconds);
  sort_runs(scores);
  return scores;
}

Scores night_scores(const TrialStudy& study) {
  Scores scores;
  for (const TrialPart& part : study.parts) {
    const std::string unit = part.run ? unit_of(*part.run) : part.id;
    for (const Trial& trial : part.trials)
      for (std::size_t i = 0; i < trial.values.size(); ++i) {
        const std::string& quantity = study.design.quantities[i].id;
        SeriesId series{trial.setup, fmt::format("{}@{:.6g}", trial.series, trial.level), 0, ""};
        series.quantity = is_history_quantity(quantity) ? quantity : "other";
        if (series.quantity == "other") series.method += " " + quantity;
        scores[std::move(series)].push_back({part.id, unit, trial.values[i]});
      }
    for (const TrialSeconds& timing : part.seconds)
      scores[{"all", timing.series, 0, "seconds"}].push_back({part.id, unit, timing.seconds});
  }
  sort_runs(scores);
  return scores;
}

std::string order_digest(const std::string& study_json, const std::string& source) {
  JsonDocument document = parse_json(study_json, source);
  document.root.erase("provenance");
  return sha256_hex(json_text(nlohmann::ordered_json(document.root)));
}

StudyNight read_study_night(const std::filesystem::path& folder, const std::string& name) {
  const std::filesystem::path head = folder / "study.json";
  StudyNight night{.name = name, .order_digest = order_digest(read_file(head), head.string())};
  if (is_slam_study(folder)) {
    const SlamStudy study = read_slam_study(folder);
    night.kind = "mapproof.slam_study";
    night.runs = static_cast<int>(study.runs.size());
    night.scores = night_scores(study, read_slam_timings(folder));
  } else if (is_trial_study(folder)) {
    const TrialStudy study = read_trial_study(folder);
    night.kind = "mapproof.trial_study";
    night.runs = static_cast<int>(study.parts.size());
    night.scores = night_scores(study);
  } else {
    const Study study = read_study(folder);
    night.kind = "mapproof.study";
    night.runs = static_cast<int>(study.runs.size());
    const std::vector<Timing> timings = read_timings(folder);
    night.scores = night_scores(study, timings);
  }
  add_sessions(night, read_sessions(folder));
  return night;
}

}  // namespace mapproof
