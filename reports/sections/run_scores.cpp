#include "reports/sections/run_scores.hpp"

#include <cmath>

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

std::optional<MeanEstimate> RunValues::mean() const {
  if (values.empty()) return std::nullopt;
  return clustered_mean(values, layouts);
}

RunValues mpe_differences_m(const SettingScores& a, const SettingScores& b) {
  RunValues differences;
  for (const auto& [run, score] : a.runs)
    if (const auto other = b.runs.find(run); other != b.runs.end())
      differences.add(run, other->second.mpe_m - score.mpe_m);
  return differences;
}

}  // namespace mapproof
