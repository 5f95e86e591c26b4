#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/model/study.hpp"
#include "core/results/values_by_run.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {

/// How one method with one parameter did at one step, run by run.
struct SettingScores {
  MethodSetting setting;
  std::map<RunId, Score> runs;  ///< Those with a usable score.
};

/// A score is used if both of the numbers that are averaged, MPE and MOE, are finite.
bool usable(const Score& score);

/// Every parameter of every method of `sensor` at `step`, in the order of the experiment.
std::vector<SettingScores> run_scores(const Study& study, const SensorStudy& sensor, int step);

/// Settings that stand method by method, a span a method.
std::vector<std::span<const SettingScores>> by_method(std::span<const SettingScores> scores);

/// Those of one setting; null if it is not among them.
const SettingScores* scores_of(std::span<const SettingScores> scores, const MethodSetting& setting);

/// Values that belong to runs; a layout is a cluster.
struct RunValues {
  std::vector<double> values;
  std::vector<RunId> runs;

  void add(const RunId& run, double value) {
    values.push_back(value);
    runs.push_back(run);
  }
  /// Empty without a value.
  std::optional<MeanEstimate> mean() const;
  /// As methods are compared by them.
  ValuesByRun by_run() const;
};

/// One error of each run.
RunValues errors_of(const SettingScores& scores, double Score::*error);

/// The layouts of the runs that by_run() names: what compare_runs() takes for groups.
GroupsByRun layouts_by_run(const Study& study);

/// The error of `b` less that of `a` over the runs that both have.
RunValues mpe_differences_m(const SettingScores& a, const SettingScores& b);

}  // namespace mapproof
