#include "reports/sections/run_scores.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace mapproof {

bool usable(const Score& score) {
  return std::isfinite(score.mpe_m) && std::isfinite(score.moe_percent);
}

std::vector<SettingScores> run_scores(const Study& study, const SensorStudy& sensor, int step) {
  std::vector<SettingScores> scores;
  for (const MethodSetting& setting : settings_of(sensor)) scores.push_back({setting, {}});
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records) {
      if (record.sensor != sensor.sensor.sensor || record.step != step) continue;
      if (!record.score || !usable(*record.score)) continue;
      for (SettingScores& candidate : scores)
        if (candidate.setting == record.setting) candidate.runs.emplace(run.id, *record.score);
    }
  return scores;
}

std::vector<std::span<const SettingScores>> by_method(std::span<const SettingScores> scores) {
  std::vector<std::span<const SettingScores>> methods;
  for (std::size_t first = 0; first < scores.size();) {
    std::size_t end = first;
    while (end < scores.size() && scores[end].setting.method == scores[first].setting.method) ++end;
    methods.push_back(scores.subspan(first, end - first));
    first = end;
  }
  return methods;
}

const SettingScores* scores_of(std::span<const SettingScores> scores,
                               const MethodSetting& setting) {
  const auto found = std::ranges::find(scores, setting, &SettingScores::setting);
  return found == scores.end() ? nullptr : &*found;
}

std::optional<MeanEstimate> RunValues::mean() const {
  if (values.empty()) return std::nullopt;
  std::vector<int> layouts;
  for (const RunId& run : runs) layouts.push_back(run.layout);
  return clustered_mean(values, layouts);
}

ValuesByRun RunValues::by_run() const {
  ValuesByRun values_by_run;
  for (std::size_t i = 0; i < values.size(); ++i) values_by_run[slug(runs[i])] = values[i];
  return values_by_run;
}

RunValues errors_of(const SettingScores& scores, double Score::*error) {
  RunValues errors;
  for (const auto& [run, score] : scores.runs) errors.add(run, score.*error);
  return errors;
}

GroupsByRun layouts_by_run(const Study& study) {
  GroupsByRun layouts;
  for (const Run& run : study.runs)
    layouts.set(slug(run.id), fmt::format("layout-{}", run.id.layout));
  return layouts;
}

RunValues mpe_differences_m(const SettingScores& a, const SettingScores& b) {
  RunValues differences;
  for (const auto& [run, score] : a.runs)
    if (const auto other = b.runs.find(run); other != b.runs.end())
      differences.add(run, other->second.mpe_m - score.mpe_m);
  return differences;
}

}  // namespace mapproof
