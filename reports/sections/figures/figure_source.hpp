#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/study.hpp"
#include "core/results/values_by_run.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/run_scores.hpp"

namespace mapproof {

/// Gives what a study keeps of its runs apart from their records.
struct StudyReader {
  std::function<std::vector<MapRecord>(const RunId&)> maps;
  std::function<std::optional<RunDetails>(const RunId&)> details;
};

/// What figures are made of: the records, and maps and details that are read once.
class FigureSource {
 public:
  /// `study` must outlive it.
  FigureSource(const Study& study, StudyReader reader);

  const Study& study() const { return study_; }

  /// Each method at its best parameter, at each checkpoint: [method][checkpoint].
  const std::vector<std::vector<SettingSummary>>& best_history(const SensorStudy& sensor);
  /// The same at the last checkpoint, methods without a score left out.
  std::vector<SettingSummary> best(const SensorStudy& sensor);
  /// Every parameter of every method at the last checkpoint, run by run.
  const std::vector<SettingScores>& scores(const SensorStudy& sensor);
  /// The layout of each run.
  const GroupsByRun& layouts() const { return layouts_; }

  /// Null if it cannot be read. Pointers hold as long as this.
  const MapRecord* map(const RunId& run, Sensor sensor, const MethodSetting& setting, int step);
  const RunDetails* details(const RunId& run);
  /// Of the sensor in that run; null if it is not there.
  const SensorDetails* details(const RunId& run, Sensor sensor);

  /// The run of that id; null if it is not finished.
  const Run* run(const RunId& id) const;

 private:
  const Study& study_;
  StudyReader reader_;
  GroupsByRun layouts_;
  std::map<Sensor, std::vector<std::vector<SettingSummary>>> best_;
  std::map<Sensor, std::vector<SettingScores>> scores_;
  std::map<RunId, std::vector<MapRecord>> maps_;
  std::map<RunId, std::optional<RunDetails>> details_;
};

/// Runs with the score of one setting at one step, by ascending MPE.
std::vector<std::pair<double, RunId>> ranked_runs(const Study& study,
                                                  const SettingSummary& setting);

/// The run whose MPE is the median (the lower one of two); empty if none was scored.
std::optional<RunId> median_run(const Study& study, const SettingSummary& setting);

/// The run whose MPE is nearest to `mpe_m`; empty if none was scored.
std::optional<RunId> nearest_run(const Study& study, const SettingSummary& setting, double mpe_m);

}  // namespace mapproof
