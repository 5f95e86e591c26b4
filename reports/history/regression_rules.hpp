#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reports/history/night.hpp"

namespace mapproof {

/// When a change counts. Chosen by simulation (docs/nightly.md has the rates that follow).
struct RegressionRules {
  double alpha = 0.001;          ///< Of all tests of one kind in one night together.
  double least_ratio = 0.01;     ///< Accuracy: changes of less, as a share, do not count.
  double least_points = 0.5;     ///< Likewise of quantities in percent, percentage points.
  double least_slowdown = 0.10;  ///< Seconds, as a share.
  double least_growth = 0.05;    ///< Memory, and accuracy without runs to pair, as a share.
  double seconds_floor = 0.02;   ///< Noise that is believed of seconds at least, as a share.
  double memory_floor = 0.01;
  double shortest_s = 1e-3;        ///< Pieces of less are not judged: a clock's tick would be.
  int least_units = 3;             ///< Fewer pairs are judged over nights.
  int least_layouts = 6;           ///< Where there are as many, their means are the units.
  int least_lost = 3;              ///< Results of a series that are lost: fewer count if all are.
  double least_lost_share = 0.25;  ///< Of its results.
  int least_good_nights = 4;       ///< Seconds and memory: nights that say what is usual.
  int most_good_nights = 20;       ///< The last so many say it.
  int least_drift_nights = 12;     ///< Change points are looked for from so many nights on.
};

/// The values of the reference night.
struct ReferenceScores {
  int night = 0;
  Scores scores = {};
};

/// A study tonight, and what it is compared with.
struct StudyEvidence {
  StudyTrend trend = {};  ///< From the pinned night on, if there is one; tonight last.
  Scores tonight = {};
  std::optional<ReferenceScores> reference = {};  ///< Empty: no night to compare with.
  bool draws_groups = false;  ///< A table of results: groups are the units, however few.
};

/// What the rules say.
struct RuleOutcome {
  std::vector<NightFinding> findings = {};
  std::vector<std::string> remarks = {};  ///< What could not be judged, or is only suspected yet.
};

/// Accuracy by pairs of equal seed: per method, of the last step and of the mean over its steps,
/// the ratio (or difference) of the two nights by paired_change(), and of results lost by the sign
/// test; p corrected for all of them by Holm. Units are layouts where there are enough, else runs;
/// where groups are drawn, groups. Losses of many results, and series that are not there any more,
/// count without a test.
RuleOutcome judge_accuracy(const StudyEvidence& evidence, const RegressionRules& rules);

/// Seconds and memory against the usual of the good nights on the same machine. What all methods of
/// a night have in common (the machine was busy) is taken off each: a method counts by what it is
/// slower beyond that. The common part, memory, and accuracy of single logs count where two nights
/// in a row are beyond the limit: a single noisy night is not flagged.
RuleOutcome judge_costs(const StudyEvidence& evidence, const RegressionRules& rules);

/// Rises at an unknown night, by rise_in(), of all of these over the nights of the trend; p
/// corrected by Holm.
/// @param found  What other rules found of tonight: it is not told twice.
RuleOutcome judge_drifts(const StudyEvidence& evidence, const RegressionRules& rules,
                         const std::vector<NightFinding>& found);

/// One number a night of each thing that is judged over nights; NaN: none.
struct NightSeries {
  NightRule rule = NightRule::kSeconds;  ///< Of a step; a drift's is made of it.
  std::string subject = {};
  std::string shown = {};  ///< The subject, for readers.
  std::string quantity = {};
  bool ratio = true;   ///< Logarithms.
  double least = 0.0;  ///< As in RegressionRules, of the values as they stand.
  double floor = 0.0;  ///< Likewise.
  std::vector<double> values = {};
};

/// The seconds of each method, what is common to all taken off, and the common part last (where
/// there are four methods or more; else each method as it is).
/// @param usual  The nights, counted from 0, that say what is usual.
std::vector<NightSeries> seconds_series(const StudyTrend& trend,
                                        const std::vector<std::size_t>& usual,
                                        const RegressionRules& rules);

/// Empty if no night knows it.
std::vector<NightSeries> memory_series(const StudyTrend& trend, const RegressionRules& rules);

/// Levels (see level_of) at the last step of each method.
std::vector<NightSeries> accuracy_series(const StudyTrend& trend, const RegressionRules& rules);

/// The nights before tonight that were good and on the same machine, the last ones.
std::vector<std::size_t> usual_nights(const StudyTrend& trend, const RegressionRules& rules);

/// "12 % higher", "0.8 points higher" of a change in a series' own values.
std::string change_words(double change, bool ratio, const std::string& word);

/// The same of a change for the worse of a level (see level_of): "12 % higher", or "lower" of what
/// is better if it is higher.
std::string worse_words(const Quantity& quantity, double worsening);

}  // namespace mapproof
