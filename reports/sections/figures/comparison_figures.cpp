#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "render/figures/critical_difference.hpp"
#include "render/figures/pareto.hpp"
#include "render/figures/shepard.hpp"
#include "render/figures/spectrum.hpp"
#include "reports/sections/figures/builders.hpp"
#include "reports/sections/method_ranks.hpp"
#include "reports/sections/run_scores.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

void add_ranks(FigureSource& source, const SensorStudy& sensor, std::vector<Figure>& figures) {
  const MethodRanks ranks = method_ranks(source.study(), sensor);
  if (!ranks.test || ranks.critical_difference <= 0.0) return;
  CriticalDifferenceSpec spec;
  spec.id = fmt::format("ranks-{}", name(sensor.sensor.sensor));
  spec.title = fmt::format("{}: mean ranks by MPE", title_of(sensor.sensor.sensor));
  for (std::size_t i = 0; i < ranks.methods.size(); ++i)
    spec.methods.push_back(
        {std::string(info(ranks.methods[i].method).label), ranks.test->mean_ranks[i]});
  spec.critical_difference = ranks.critical_difference;
  spec.alpha = ranks.alpha;
  spec.units = ranks.test->units;
  spec.friedman_p = ranks.test->chi_square_p;
  for (const SettingSummary& best : source.best(sensor)) spec.record_ids.push_back(source_of(best));
  figures.push_back(critical_difference_figure(spec));
}

/// Of the pairs in the order of SensorDetails::distances.
std::vector<double> map_distances(const Points& points) {
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (Eigen::Index j = i + 1; j < points.rows(); ++j)
      distances.push_back((points.row(i) - points.row(j)).norm());
  return distances;
}

/// The run that all methods are shown of: the median one of the best method.
std::optional<RunId> shown_run(FigureSource& source, const SensorStudy& sensor) {
  const std::vector<SettingSummary> all = source.best(sensor);
  const SettingSummary* best = best_of(all);
  return best == nullptr ? std::nullopt : median_run(source.study(), *best);
}

void add_distances(FigureSource& source, const SensorStudy& sensor, const RunId& run,
                   std::vector<Figure>& figures) {
  const SensorDetails* details = source.details(run, sensor.sensor.sensor);
  if (details == nullptr) return;
  ShepardSpec spec;
  spec.id = fmt::format("distances-{}", name(details->sensor));
  spec.title = fmt::format("{}: map distance against observed distance, layout {}, pose {}",
                           title_of(details->sensor), run.layout, run.pose);
  for (const SettingSummary& best : source.best(sensor)) {
    const MapRecord* map = source.map(run, best.sensor, best.setting, best.step);
    if (map == nullptr || map->frame != Frame::kTruth || best.step != details->step) continue;
    spec.methods.push_back({label(best.setting),
                            {details->distances.begin(), details->distances.end()},
                            map_distances(map->estimate)});
    spec.record_ids.push_back(map->id);
  }
  if (!spec.methods.empty()) figures.push_back(shepard_figure(spec));
}

void add_spectra(FigureSource& source, const SensorStudy& sensor, const RunId& run,
                 std::vector<Figure>& figures) {
  const SensorDetails* details = source.details(run, sensor.sensor.sensor);
  if (details == nullptr) return;
  SpectrumSpec spec;
  spec.id = fmt::format("spectrum-{}", name(details->sensor));
  spec.title = fmt::format("{}: leading eigenvalues, layout {}, pose {}", title_of(details->sensor),
                           run.layout, run.pose);
  bool any = false;
  for (const SettingSummary& best : source.best(sensor)) {
    SpectrumPanel& panel = spec.methods.emplace_back(label(best.setting), std::vector<double>());
    for (const auto& [setting, values] : details->spectra)
      if (setting == best.setting) panel.eigenvalues.assign(values.begin(), values.end());
    any = any || !panel.eigenvalues.empty();
    spec.record_ids.push_back(record_id(run, best.sensor, best.setting, best.step));
  }
  if (any) figures.push_back(spectrum_figure(spec));
}

}  // namespace

std::vector<Figure> comparison_figures(FigureSource& source) {
  std::vector<Figure> figures;
  const auto& sensors = source.study().experiment.sensors;
  for (const SensorStudy& sensor : sensors) add_ranks(source, sensor, figures);
  for (const SensorStudy& sensor : sensors)
    if (const auto run = shown_run(source, sensor)) {
      add_distances(source, sensor, *run, figures);
      add_spectra(source, sensor, *run, figures);
    }
  return figures;
}

std::vector<Figure> cost_figures(FigureSource& source, std::span<const Timing> timings) {
  using Key = std::tuple<Sensor, int, Method, double>;
  std::map<Key, std::pair<double, int>> seconds;
  const auto key = [](Sensor sensor, int step, const MethodSetting& setting) {
    return Key{sensor, step, setting.method, setting.parameter.value_or(0.0)};
  };
  for (const Timing& timing : timings) {
    auto& [sum, count] = seconds[key(timing.sensor, timing.step, timing.setting)];
    sum += timing.seconds;
    ++count;
  }
  std::vector<Figure> figures;
  for (const SensorStudy& sensor : source.study().experiment.sensors) {
    ParetoSpec spec;
    spec.id = fmt::format("cost-{}", name(sensor.sensor.sensor));
    spec.title = fmt::format("{}: error against seconds a map", title_of(sensor.sensor.sensor));
    for (const SettingSummary& best : source.best(sensor)) {
      const auto found = seconds.find(key(best.sensor, best.step, best.setting));
      if (found == seconds.end() || !best.mpe_m) continue;
      spec.settings.push_back(
          {label(best.setting), found->second.first / found->second.second, best.mpe_m->mean});
      spec.record_ids.push_back(source_of(best));
    }
    if (!spec.settings.empty()) figures.push_back(pareto_figure(spec));
  }
  return figures;
}

}  // namespace mapproof
