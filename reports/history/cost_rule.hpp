#pragma once

#include <string>
#include <vector>

#include "reports/history/nightly_run.hpp"
#include "reports/history/regression_rules.hpp"

namespace mapproof {

/// Seconds and memory against the usual of the passing nightly runs on the same machine. What all
/// methods of a nightly run have in common (the machine was busy) is taken off each: a method
/// counts by what it is slower beyond that. The common part, memory, and accuracy of single logs
/// count where two nightly runs in a row are beyond the limit: a single noisy nightly run is not
/// flagged.
RuleOutcome judge_costs(const StudyEvidence& evidence, const RegressionRules& rules);

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

/// The nightly runs before this one that passed and were on the same machine, the last ones.
std::vector<std::size_t> usual_nightly_runs(const StudyTrend& trend, const RegressionRules& rules);

}  // namespace mapproof
