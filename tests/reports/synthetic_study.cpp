#include "tests/reports/synthetic_study.hpp"

#include <cmath>

#include "reports/sections/method_summary.hpp"

namespace mapproof::test {
namespace {

SensorStudy sensor_study(Sensor sensor, std::vector<int> checkpoints, const std::string& source,
                         std::vector<PublishedValue> published) {
  SensorStudy study;
  study.sensor.sensor = sensor;
  study.checkpoints = std::move(checkpoints);
  study.methods = {{Method::kLpca, {}},
                   {Method::kSmacof, {}},
                   {Method::kSmacofKnn, {5, 6, 8}},
                   {Method::kIsomap, {4, 6, 9}}};
  study.published.source = source;
  study.published.values = std::move(published);
  return study;
}

Experiment synthetic_experiment(int layouts, int poses) {
  Experiment experiment;
  experiment.name = "synthetic";
  experiment.title = "Maps without localization, a synthetic study";
  experiment.seed = 2007;
  experiment.layouts = layouts;
  experiment.poses = poses;
  experiment.sensors = {
      sensor_study(Sensor::kVisibility, {500, 1000, 1500, 2000}, "Yairi 2007, Table 1",
                   {{{Method::kLpca, {}}, 1.055, 18.19},
                    {{Method::kSmacof, {}}, 0.421, 5.86},
                    {{Method::kSmacofKnn, 5}, 0.206, 4.83},
                    {{Method::kIsomap, 6}, 0.177, 4.11}}),
      sensor_study(Sensor::kBearing, {200, 400, 1000, 2000}, "Yairi 2007, Table 2",
                   {{{Method::kLpca, {}}, 0.168, 2.33},
                    {{Method::kSmacof, {}}, 0.101, 1.38},
                    {{Method::kSmacofKnn, 8}, 0.0609, 1.00},
                    {{Method::kIsomap, 9}, 0.0979, 1.83}})};
  return experiment;
}

RunRecord synthetic_record(Sensor sensor, const MethodSetting& setting, const RunId& run,
                           int step) {
  RunRecord record;
  record.sensor = sensor;
  record.setting = setting;
  record.step = step;
  const double mpe = synthetic_mpe(setting, run, step);
  record.score = Score{mpe, 20.0 * mpe, 0.8 * mpe, 20.0 * mpe};
  if (setting.method == Method::kIsomap && setting.parameter == 4.0) {
    record.statuses.push_back(
        status_with_message(StatusCode::kBridged, "2 pieces of 3 and 9 landmarks; 1 bridge."));
    if (run == RunId{1, 1}) {
      record.statuses.push_back(
          status_with_message(StatusCode::kFailed, "The matrix of distances is not finite."));
      record.score.reset();
    }
  }
  if (setting.method == Method::kSmacof && step <= 500)
    record.statuses.push_back(
        status_with_message(StatusCode::kNotConverged, "300 iterations, relative fall 2e-4."));
  return record;
}

Points grid_points() {
  Points points(12, 2);
  for (Eigen::Index i = 0; i < 12; ++i)
    points.row(i) << 0.3 + 0.6 * static_cast<double>(i % 4), 0.3 + 0.9 * static_cast<double>(i / 4);
  return points;
}

}  // namespace

double synthetic_mpe(const MethodSetting& setting, const RunId& run, int step) {
  constexpr double kBase[] = {0.2, 0.09, 0.04, 0.3, 0.25, 0.05, 0.1, 0.15, 0.06};
  const double tuned = setting.parameter ? 1.0 + 0.1 * std::abs(*setting.parameter - 6.0) : 1.0;
  return kBase[static_cast<int>(setting.method)] * tuned *
         (1.0 + 0.1 * run.layout + 0.01 * run.pose) * 200.0 / std::sqrt(step);
}

Study synthetic_study(int layouts, int poses) {
  Study study;
  study.experiment = synthetic_experiment(layouts, poses);
  study.provenance = {"0.1.0", "0123456789ab", std::string(64, 'c'), {{"Eigen", "3.4.0"}}};
  for (int layout = 1; layout <= layouts; ++layout)
    for (int pose = 1; pose <= poses; ++pose) {
      Run& run = study.runs.emplace_back();
      run.id = {layout, pose};
      for (const SensorStudy& sensor : study.experiment.sensors)
        for (const MethodGrid& grid : sensor.methods) {
          std::vector<std::optional<double>> parameters(grid.parameters.begin(),
                                                        grid.parameters.end());
          if (parameters.empty()) parameters.emplace_back();
          for (const auto& parameter : parameters)
            for (const int step : sensor.checkpoints)
              run.records.push_back(
                  synthetic_record(sensor.sensor.sensor, {grid.method, parameter}, run.id, step));
        }
    }
  return study;
}

std::vector<MapRecord> synthetic_maps(const Study& study, const RunId& run) {
  std::vector<MapRecord> maps;
  for (const Run& candidate : study.runs) {
    if (candidate.id != run) continue;
    for (const RunRecord& record : candidate.records) {
      if (!record.score) continue;
      MapRecord& map = maps.emplace_back();
      map.id = record_id(run, record.sensor, record.setting, record.step);
      map.origin = FromSensor{record.sensor, record.setting};
      map.step = record.step;
      map.ground_truth_m = grid_points();
      map.estimate = grid_points();
      map.anchors = {0, 3, 8, 11};
      map.statuses = record.statuses;
      map.score = record.score;
      for (Eigen::Index i = 0; i < 12; ++i) {
        map.names.push_back("landmark " + std::to_string(i + 1));
        const double angle = 2.4 * static_cast<double>(i);
        map.estimate(i, 0) += record.score->mpe_m * std::cos(angle);
        map.estimate(i, 1) += record.score->mpe_m * std::sin(angle);
      }
    }
  }
  return maps;
}

std::vector<Timing> synthetic_timings(const Study& study) {
  std::vector<Timing> timings;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records)
      timings.push_back({run.id, record.sensor, record.setting, record.step,
                         1e-3 * (1.0 + static_cast<double>(record.setting.method))});
  return timings;
}

std::vector<Session> synthetic_sessions() {
  return {{"mapproof run yairi2007 --out out --seed 2007", "2026-01-02T03:04:05Z", "workshop", 2,
           75.0, std::nullopt}};
}

StudyFigures synthetic_figures(const Study& study) {
  return study_figures(study, synthetic_timings(study),
                       {.maps = [&](const RunId& run) { return synthetic_maps(study, run); },
                        .details = [](const RunId&) { return std::nullopt; }});
}

}  // namespace mapproof::test
