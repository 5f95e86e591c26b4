#include "tests/reports/diff/small_study.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/statistics/intervals.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "render/figures/maps/map.hpp"
#include "render/output/write_figure.hpp"
#include "render/plot/figure_json.hpp"

namespace mapproof::test {
namespace {

constexpr int kLandmarks = 12;
constexpr Sensor kSensor = Sensor::kVisibility;

Experiment experiment_of(std::uint64_t seed, int layouts, double neighbours) {
  Experiment experiment;
  experiment.name = "small";
  experiment.title = "Small";
  experiment.seed = seed;
  experiment.layouts = layouts;
  experiment.world.landmarks = kLandmarks;
  SensorStudy sensor;
  sensor.sensor.sensor = kSensor;
  sensor.checkpoints = {100, 200};
  sensor.methods = {{Method::kLpca, {}}, {Method::kIsomap, {neighbours}}};
  experiment.sensors = {sensor};
  return experiment;
}

Points grid(Random& random) {
  Points points(kLandmarks, 2);
  for (Eigen::Index i = 0; i < kLandmarks; ++i)
    points.row(i) << 0.4 + 0.55 * static_cast<double>(i % 4) + random.uniform(-0.1, 0.1),
        0.4 + 0.8 * static_cast<double>(i / 4) + random.uniform(-0.1, 0.1);
  return points;
}

double mpe_of(const MapRecord& map) {
  double sum = 0.0;
  int count = 0;
  for (Eigen::Index i = 0; i < map.estimate.rows(); ++i) {
    if (std::ranges::find(map.anchors, i) != map.anchors.end()) continue;
    if (!map.estimate.row(i).allFinite()) continue;
    sum += (map.estimate.row(i) - map.ground_truth_m->row(i)).norm();
    ++count;
  }
  return sum / count;
}

MapRecord make_map(const RunId& run, const MethodSetting& setting, int step,
                   const Points& ground_truth, Random& random) {
  MapRecord map;
  map.id = record_id(run, kSensor, setting, step);
  map.origin = FromSensor{kSensor, setting};
  map.step = step;
  map.anchors = {0, 3, 8, 11};
  map.ground_truth_m = ground_truth;
  map.estimate = ground_truth;
  const double error_m = (setting.method == Method::kLpca ? 0.1 : 0.05) * (step == 100 ? 1.4 : 1.0);
  for (Eigen::Index i = 0; i < kLandmarks; ++i) {
    map.names.push_back("L" + std::to_string(i + 1));
    map.estimate(i, 0) += error_m * random.normal();
    map.estimate(i, 1) += error_m * random.normal();
  }
  return map;
}

/// The mean of a setting at a step over all runs.
MeanEstimate mean_of(const Study& study, const MethodSetting& setting, int step) {
  std::vector<double> values;
  std::vector<int> layouts;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records)
      if (record.setting == setting && record.step == step && record.score) {
        values.push_back(record.score->mpe_m);
        layouts.push_back(run.id.layout);
      }
  return clustered_mean(values, layouts);
}

Figure curve_figure(const Study& study) {
  ErrorCurveSpec spec;
  spec.id = "mpe-curve";
  spec.title = "MPE over the steps";
  const SensorStudy& sensor = study.experiment.sensors[0];
  for (const MethodSetting& setting : settings_of(sensor)) {
    ErrorLine& line = spec.curves.emplace_back();
    line.label = label(setting);
    line.key = info(setting.method).name;
    for (const int step : sensor.checkpoints) {
      const MeanEstimate mean = mean_of(study, setting, step);
      line.x.push_back(step);
      line.mean.push_back(mean.mean);
      line.low.push_back(mean.mean - mean.half_width.value_or(0.0));
      line.high.push_back(mean.mean + mean.half_width.value_or(0.0));
      spec.record_ids.push_back(
          fmt::format("{}/{}/{} of {} runs", name(kSensor), slug(setting), step, mean.values));
    }
  }
  return error_curve_figure(spec);
}

}  // namespace

SmallStudy::SmallStudy(std::uint64_t seed, int layouts, double neighbours) {
  study.experiment = experiment_of(seed, layouts, neighbours);
  study.provenance = {"0.1.0", "0123456789ab", std::string(64, 'c'), {{"Eigen", "3.4.0"}}};
  for (int layout = 1; layout <= layouts; ++layout) {
    Run& run = study.runs.emplace_back();
    run.id = {layout, 1};
    Random random(derive_seed(seed, {static_cast<std::uint64_t>(layout)}));
    run.world = {.side_m = 2.5, .landmark_diameter_m = 0.048, .landmarks_m = grid(random)};
    run.anchors = {0, 3, 8, 11};
    for (const MethodSetting& setting : settings_of(study.experiment.sensors[0]))
      for (const int step : study.experiment.sensors[0].checkpoints) {
        RunRecord& record = run.records.emplace_back();
        record.sensor = kSensor;
        record.setting = setting;
        record.step = step;
        maps[run.id].push_back(make_map(run.id, setting, step, run.world.landmarks_m, random));
      }
  }
  rescore();
}

MapRecord& SmallStudy::map(const std::string& id) {
  for (auto& [run, list] : maps)
    for (MapRecord& map : list)
      if (map.id == id) return map;
  throw std::out_of_range(id);
}

void SmallStudy::for_each_map(const std::string& subject,
                              const std::function<void(MapRecord&)>& change) {
  for (auto& [run, list] : maps)
    for (MapRecord& map : list)
      if (map.id.ends_with("/" + subject)) change(map);
}

void SmallStudy::rescore() {
  for (Run& run : study.runs)
    for (std::size_t i = 0; i < run.records.size(); ++i) {
      MapRecord& map = maps.at(run.id)[i];
      const double mpe = mpe_of(map);
      map.score = Score{mpe, 20.0 * mpe, 0.8 * mpe, 20.0 * mpe};
      run.records[i].score = map.score;
    }
}

std::vector<Figure> SmallStudy::figures() const {
  std::vector<Figure> all;
  for (const MapRecord& map : maps.at({2, 1}))
    if (map.step == 200) all.push_back(map_figure(map, "map-" + std::string(method_name(map))));
  all.push_back(curve_figure(study));
  return all;
}

void write_study_figure(const Figure& figure, const Theme& theme,
                        const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "figures" / figure.id;
  write_file(file.string() + ".figure.json", figure_to_json(figure));
  write_file(file.string() + ".svg", figure_svg(figure, theme));
  write_file(file.string() + ".png", figure_png(figure, theme));
}

void SmallStudy::write_records(const std::filesystem::path& folder) const {
  StudyWriter store = StudyWriter(folder, study_start(study.experiment, study.provenance));
  for (const Run& run : study.runs)
    store.write(part_of({.run = run,
                         .details = {.id = run.id, .path = {}, .sensors = {}},
                         .maps = maps.at(run.id),
                         .timings = {}}));
}

}  // namespace mapproof::test
