#pragma once

#include <optional>
#include <string>

#include "reports/history/nightly_run.hpp"
#include "reports/history/regression_rules.hpp"

namespace mapproof {

/// Accuracy by pairs of equal seed: per method, of the last step and of the mean over its steps,
/// the ratio (or difference) of the two nightly runs by paired_change(), and of results lost by the
/// sign test; p corrected for all of them by Holm. Units are layouts where there are enough, else
/// runs; where groups are drawn, groups. Losses of many results, and series that are not there any
/// more, count without a test.
RuleOutcome judge_accuracy(const StudyEvidence& evidence, const RegressionRules& rules);

/// "12 % higher", "0.8 points higher" of a change in a series' own values.
std::string change_words(double change, bool ratio, const std::string& word);

/// By how much values changed: in percent, or in points of what is judged by points; the sign is
/// that of the change of the values. Nothing of what was 0.
/// @param before     A level (see level_of).
/// @param worsening  Of the level.
std::optional<double> change_of(const Quantity& quantity, double before, double worsening);

/// The same of a change for the worse of a level (see level_of): "12 % higher", or "lower" of what
/// is better if it is higher; "0.00400 m higher" of what was 0.
std::string worse_words(const Quantity& quantity, double before, double worsening);

}  // namespace mapproof
