#pragma once

#include <vector>

#include "reports/history/nightly_run.hpp"
#include "reports/history/regression_rules.hpp"

namespace mapproof {

/// Rises at an unknown nightly run, by rise_in(), of all of these over the nightly runs of the
/// trend; p corrected by Holm.
/// @param found  What other rules found of this nightly run: it is not reported twice.
RuleOutcome judge_drifts(const StudyEvidence& evidence, const RegressionRules& rules,
                         const std::vector<NightlyFinding>& found);

}  // namespace mapproof
