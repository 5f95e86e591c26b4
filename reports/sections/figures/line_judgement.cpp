#include "reports/sections/figures/line_judgement.hpp"

#include <utility>

#include "reports/sections/results/paired_methods.hpp"
#include "reports/sections/run_scores.hpp"

namespace mapproof {

void judge(std::vector<PointOfRuns> points, const GroupsByRun& layouts) {
  std::vector<MethodRuns> methods;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].runs.empty()) methods.push_back({i, std::move(points[i].runs)});
  const auto comparison = compare_runs(std::move(methods), layouts, true);
  if (!comparison) return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ErrorLine& line = *points[i].line;
    line.paired.resize(line.x.size(), PairedWithBest::kUntested);
    line.paired[points[i].index] = judgement_of(*comparison, i);
  }
}

void judge(const std::vector<PointOfSetting>& points, double Score::*error,
           const SensorStudy& sensor, FigureSource& source) {
  std::vector<PointOfRuns> of_runs;
  for (const auto& [line, index, setting] : points)
    if (const SettingScores* scores = scores_of(source.scores(sensor), setting))
      of_runs.push_back({line, index, errors_of(*scores, error).by_run()});
  judge(std::move(of_runs), source.layouts());
}

}  // namespace mapproof
