#include "reports/sections/figures/figure_source.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace mapproof {

FigureSource::FigureSource(const Study& study, StudyReader reader)
    : study_(study), reader_(std::move(reader)), layouts_(layouts_by_run(study)) {}

const std::vector<std::vector<SettingSummary>>& FigureSource::best_history(
    const SensorStudy& sensor) {
  const auto [found, is_new] = best_.try_emplace(sensor.sensor.sensor);
  if (!is_new) return found->second;
  const auto chosen = best_of_each_method(summarize(study_, sensor, last_step(sensor)));
  auto& history = found->second;
  history.resize(chosen.size());
  for (const auto& at_step : summarize(study_, sensor, sensor.checkpoints))
    for (const SettingSummary& summary : at_step)
      for (std::size_t i = 0; i < chosen.size(); ++i)
        if (chosen[i].setting == summary.setting) history[i].push_back(summary);
  return history;
}

std::vector<SettingSummary> FigureSource::best(const SensorStudy& sensor) {
  std::vector<SettingSummary> last;
  for (const auto& steps : best_history(sensor))
    if (!steps.empty() && steps.back().scored > 0) last.push_back(steps.back());
  return last;
}

const std::vector<SettingScores>& FigureSource::scores(const SensorStudy& sensor) {
  const auto [found, is_new] = scores_.try_emplace(sensor.sensor.sensor);
  if (is_new) found->second = run_scores(study_, sensor, last_step(sensor));
  return found->second;
}

const MapRecord* FigureSource::map(const RunId& run, Sensor sensor, const MethodSetting& setting,
                                   int step) {
  const auto [found, is_new] = maps_.try_emplace(run);
  if (is_new) found->second = reader_.maps(run);
  for (const MapRecord& map : found->second)
    if (map.origin == MapOrigin(FromSensor{sensor, setting}) && map.step == step) return &map;
  return nullptr;
}

const RunDetails* FigureSource::details(const RunId& run) {
  const auto [found, is_new] = details_.try_emplace(run);
  if (is_new) found->second = reader_.details(run);
  return found->second ? &*found->second : nullptr;
}

const SensorDetails* FigureSource::details(const RunId& run, Sensor sensor) {
  const RunDetails* all = details(run);
  if (all == nullptr) return nullptr;
  const auto found = std::ranges::find(all->sensors, sensor, &SensorDetails::sensor);
  return found == all->sensors.end() ? nullptr : &*found;
}

const Run* FigureSource::run(const RunId& id) const {
  const auto found = std::ranges::find(study_.runs, id, &Run::id);
  return found == study_.runs.end() ? nullptr : &*found;
}

std::vector<std::pair<double, RunId>> ranked_runs(const Study& study,
                                                  const SettingSummary& setting) {
  std::vector<std::pair<double, RunId>> runs;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records)
      if (record.sensor == setting.sensor && record.setting == setting.setting &&
          record.step == setting.step && record.score && usable(*record.score))
        runs.emplace_back(record.score->mpe_m, run.id);
  std::ranges::sort(runs);
  return runs;
}

std::optional<RunId> median_run(const Study& study, const SettingSummary& setting) {
  const auto runs = ranked_runs(study, setting);
  if (runs.empty()) return std::nullopt;
  return runs[(runs.size() - 1) / 2].second;
}

std::optional<RunId> nearest_run(const Study& study, const SettingSummary& setting, double mpe_m) {
  const auto runs = ranked_runs(study, setting);
  if (runs.empty()) return std::nullopt;
  return std::ranges::min_element(runs, {},
                                  [&](const auto& run) { return std::abs(run.first - mpe_m); })
      ->second;
}

}  // namespace mapproof
