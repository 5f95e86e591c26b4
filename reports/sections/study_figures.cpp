#include "reports/sections/study_figures.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "render/figures/error_curve.hpp"
#include "render/figures/map.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// One of the two quantities that curves show.
struct Measure {
  const char* id;
  const char* name;
  const char* unit;
  const char* words;
  std::optional<MeanEstimate> SettingSummary::*estimate;
};

constexpr Measure kMpe{"mpe", "MPE", "m", "mean position error", &SettingSummary::mpe_m};
constexpr Measure kMoe{"moe", "MOE", "%", "mean orientation error", &SettingSummary::moe_percent};

/// Methods that share a figure: the paper, too, draws its curves in two.
struct Family {
  const char* id;
  const char* words;
  bool on_graph;
};

constexpr Family kFamilies[] = {{"global", "without a neighbour graph", false},
                                {"graph", "on a neighbour graph", true}};

/// Summaries at every checkpoint of the settings that are best at the last.
using History = std::vector<std::vector<SettingSummary>>;

History best_history(const Study& study, const SensorStudy& sensor) {
  const auto best = best_of_each_method(summarize(study, sensor, last_step(sensor)));
  History history(best.size());
  for (const auto& at_step : summarize(study, sensor, sensor.checkpoints))
    for (const SettingSummary& summary : at_step)
      for (std::size_t i = 0; i < best.size(); ++i)
        if (best[i].setting == summary.setting) history[i].push_back(summary);
  return history;
}

Curve curve(const std::vector<SettingSummary>& steps, const Measure& measure) {
  Curve curve;
  curve.label = label(steps.front().setting);
  curve.key = std::string(info(steps.front().setting.method).name);
  bool any_interval = false;
  for (const SettingSummary& summary : steps) {
    const auto& estimate = summary.*measure.estimate;
    const auto interval = interval_of(estimate);
    curve.steps.push_back(summary.step);
    curve.mean.push_back(estimate ? estimate->mean : kNan);
    curve.low.push_back(interval ? interval->low : kNan);
    curve.high.push_back(interval ? interval->high : kNan);
    any_interval = any_interval || interval;
  }
  if (!any_interval) {
    curve.low.clear();
    curve.high.clear();
  }
  return curve;
}

bool has_score(const std::vector<SettingSummary>& steps) {
  return std::ranges::any_of(steps, [](const SettingSummary& s) { return s.scored > 0; });
}

std::string curve_caption(const std::vector<std::vector<SettingSummary>>& curves,
                          const Measure& measure, const Family& family) {
  std::string ends;
  for (const auto& steps : curves) {
    const auto& estimate = steps.back().*measure.estimate;
    if (!estimate) continue;
    ends += fmt::format("{}{}: {:.3g} {}", ends.empty() ? "" : "; ", label(steps.back().setting),
                        estimate->mean, measure.unit);
  }
  const SettingSummary& first = curves.front().back();
  return fmt::format("{}, methods {}: {} ({}) over observations. After {} of them \u2013 {}.",
                     title_of(first.sensor), family.words, measure.words, measure.name, first.step,
                     ends);
}

std::optional<Figure> curve_figure(const History& history, const Measure& measure,
                                   const Family& family) {
  std::vector<std::vector<SettingSummary>> shown;
  for (const auto& steps : history)
    if (!steps.empty() && on_graph(steps.front().setting.method) == family.on_graph &&
        has_score(steps))
      shown.push_back(steps);
  if (shown.empty()) return std::nullopt;
  const Sensor sensor = shown.front().front().sensor;
  ErrorCurveSpec spec;
  spec.id = fmt::format("{}-{}-{}", measure.id, name(sensor), family.id);
  spec.title = fmt::format("{}, {}: methods {}", title_of(sensor), measure.name, family.words);
  spec.y_label = fmt::format("{} [{}]", measure.name, measure.unit);
  spec.quantity = measure.words;
  spec.caption = curve_caption(shown, measure, family);
  for (const auto& steps : shown) {
    spec.curves.push_back(curve(steps, measure));
    for (const SettingSummary& summary : steps) spec.record_ids.push_back(source_of(summary));
  }
  return error_curve_figure(spec);
}

/// The run whose MPE is the median (the lower one of two).
std::optional<RunId> median_run(const Study& study, const SettingSummary& setting) {
  std::vector<std::pair<double, RunId>> runs;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records)
      if (record.sensor == setting.sensor && record.setting == setting.setting &&
          record.step == setting.step && record.score)
        runs.emplace_back(record.score->mpe_m, run.id);
  std::erase_if(runs, [](const auto& run) { return run.first != run.first; });
  if (runs.empty()) return std::nullopt;
  std::ranges::sort(runs);
  return runs[(runs.size() - 1) / 2].second;
}

/// One map to show, and where it belongs.
struct WantedMap {
  std::size_t sensor;  ///< Index into StudyFigures::sensors.
  std::size_t place;   ///< Among that sensor's maps.
  SettingSummary setting;
};

bool is(const MapRecord& record, const SettingSummary& setting) {
  return record.sensor == setting.sensor && record.setting == setting.setting &&
         record.step == setting.step;
}

void add_maps(const std::vector<std::pair<RunId, WantedMap>>& wanted, const MapReader& read_maps,
              StudyFigures& figures) {
  std::map<RunId, std::vector<WantedMap>> by_run;
  for (const auto& [run, map] : wanted) by_run[run].push_back(map);
  // Placed by index: reading goes run by run, showing goes method by method.
  std::vector<std::map<std::size_t, Figure>> found(figures.sensors.size());
  for (const auto& [run, maps] : by_run) {
    const std::vector<MapRecord> records = read_maps(run);
    for (const WantedMap& map : maps)
      for (const MapRecord& record : records)
        if (is(record, map.setting)) {
          const std::string id =
              fmt::format("map-{}-{}", name(record.sensor), info(record.setting.method).name);
          found[map.sensor].insert_or_assign(map.place, map_figure(record, id));
        }
  }
  for (std::size_t sensor = 0; sensor < found.size(); ++sensor)
    for (auto& [place, figure] : found[sensor])
      figures.sensors[sensor].maps.push_back(std::move(figure));
}

}  // namespace

StudyFigures study_figures(const Study& study, const MapReader& read_maps) {
  StudyFigures figures;
  std::vector<std::pair<RunId, WantedMap>> wanted;
  for (const SensorStudy& sensor : study.experiment.sensors) {
    SensorFigures& drawn = figures.sensors.emplace_back();
    drawn.sensor = sensor.sensor.sensor;
    const History history = best_history(study, sensor);
    for (const Measure& measure : {kMpe, kMoe})
      for (const Family& family : kFamilies)
        if (auto figure = curve_figure(history, measure, family))
          drawn.curves.push_back(*std::move(figure));
    for (std::size_t i = 0; i < history.size(); ++i) {
      if (history[i].empty()) continue;
      if (const auto run = median_run(study, history[i].back()))
        wanted.push_back({*run, {figures.sensors.size() - 1, i, history[i].back()}});
    }
  }
  add_maps(wanted, read_maps, figures);
  return figures;
}

std::vector<const Figure*> all_figures(const StudyFigures& figures) {
  std::vector<const Figure*> all;
  for (const SensorFigures& sensor : figures.sensors)
    for (const Figure& figure : sensor.curves) all.push_back(&figure);
  for (const SensorFigures& sensor : figures.sensors)
    for (const Figure& figure : sensor.maps) all.push_back(&figure);
  return all;
}

}  // namespace mapproof
