#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// When a change counts. Chosen by simulation (docs/nightly.md has the rates that follow).
struct RegressionRules {
  double alpha = 0.001;          ///< Of all tests of one rule in one nightly run together.
  double least_ratio = 0.01;     ///< Accuracy: changes of less, as a share, do not count.
  double least_points = 0.5;     ///< Likewise of quantities in percent, percentage points.
  double least_slowdown = 0.10;  ///< Seconds, as a share.
  double least_growth = 0.05;    ///< Memory, and accuracy without runs to pair, as a share.
  double seconds_floor = 0.02;   ///< The least noise that is assumed of seconds, as a share.
  double memory_floor = 0.01;
  double shortest_s =
      1e-3;               ///< Shorter parts are not judged: the resolution of the clock would be.
  int least_units = 3;    ///< With fewer pairs a series is judged over nightly runs.
  int least_layouts = 6;  ///< With as many or more, their means are the units.
  int least_lost = 3;     ///< Lost results of a series; fewer count if all are lost.
  double least_lost_share = 0.25;   ///< Of its results.
  int least_good_nightly_runs = 4;  ///< Seconds and memory: nightly runs that define what is usual.
  int most_good_nightly_runs = 20;  ///< At most, the last ones.
  int least_drift_nightly_runs = 12;  ///< Change points are searched from so many nightly runs on.
};

/// The values of the reference nightly run.
struct ReferenceScores {
  int nightly_run = 0;
  Scores scores = {};
};

/// A study of this nightly run, and what it is compared with.
struct StudyEvidence {
  StudyTrend trend = {};  ///< From the pinned reference on, if there is one; this nightly run last.
  Scores this_run = {};
  std::optional<ReferenceScores> reference = {};  ///< Empty: no nightly run to compare with.
  bool draws_groups = false;  ///< A table of results: groups are the units, however few.
};

/// What the rules found.
struct RuleOutcome {
  std::vector<NightlyFinding> findings = {};
  std::vector<std::string> remarks = {};  ///< What could not be judged, or is only suspected yet.
};

/// Accuracy by pairs of equal seed: per method, of the last step and of the mean over its steps,
/// the ratio (or difference) of the two nightly runs by paired_change(), and of results lost by the
/// sign test; p corrected for all of them by Holm. Units are layouts where there are enough, else
/// runs; where groups are drawn, groups. Losses of many results, and series that are not there any
/// more, count without a test.
RuleOutcome judge_accuracy(const StudyEvidence& evidence, const RegressionRules& rules);

/// Seconds and memory against the usual of the passing nightly runs on the same machine. What all
/// methods of a nightly run have in common (the machine was busy) is taken off each: a method
/// counts by what it is slower beyond that. The common part, memory, and accuracy of single logs
/// count where two nightly runs in a row are beyond the limit: a single noisy nightly run is not
/// flagged.
RuleOutcome judge_costs(const StudyEvidence& evidence, const RegressionRules& rules);

/// Rises at an unknown nightly run, by rise_in(), of all of these over the nightly runs of the
/// trend; p corrected by Holm.
/// @param found  What other rules found of this nightly run: it is not reported twice.
RuleOutcome judge_drifts(const StudyEvidence& evidence, const RegressionRules& rules,
                         const std::vector<NightlyFinding>& found);

/// One number per nightly run of each thing that is judged over nightly runs; NaN: none.
struct NightlySeries {
  HistoryRule rule = HistoryRule::kSeconds;  ///< Of a step; a drift's is made of it.
  std::string subject = {};
  std::string shown = {};  ///< The subject, for readers.
  std::string quantity = {};
  bool ratio = true;   ///< Logarithms.
  double least = 0.0;  ///< As in RegressionRules, of the values as they are stored.
  double floor = 0.0;  ///< Likewise.
  std::vector<double> values = {};
};

/// The seconds of each method, what is common to all taken off, and the common part last (where
/// there are four methods or more; else each method as it is).
/// @param usual  The nightly runs, counted from 0, that define what is usual.
std::vector<NightlySeries> seconds_series(const StudyTrend& trend,
                                          const std::vector<std::size_t>& usual,
                                          const RegressionRules& rules);

/// Empty if no nightly run knows it.
std::vector<NightlySeries> memory_series(const StudyTrend& trend, const RegressionRules& rules);

/// Levels (see level_of) at the last step of each method.
std::vector<NightlySeries> accuracy_series(const StudyTrend& trend, const RegressionRules& rules);

/// The nightly runs before this one that were good and on the same machine, the last ones.
std::vector<std::size_t> usual_nightly_runs(const StudyTrend& trend, const RegressionRules& rules);

/// "12 % higher", "0.8 points higher" of a change in a series' own values.
std::string change_words(double change, bool ratio, const std::string& word);

/// The same of a change for the worse of a level (see level_of): "12 % higher", or "lower" of what
/// is better if it is higher.
std::string worse_words(const Quantity& quantity, double worsening);

}  // namespace mapproof
