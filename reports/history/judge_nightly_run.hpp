#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/history/history_store.hpp"
#include "reports/history/regression_rules.hpp"

namespace mapproof {

/// Applies all rules to one study and dates their findings.
/// @param yesterday  The findings of the nightly run before this one: a finding that continues
/// keeps its date.
RuleOutcome judge_study(const StudyEvidence& evidence, const RegressionRules& rules,
                        const std::vector<NightlyFinding>& yesterday);

/// Whether a nightly run of the store has the study, ordered as in this nightly run. @throws
/// IoError.
bool has_study(HistoryStore& store, int nightly_run, const NightlyStudy& this_run);

/// The nightly run that this one is compared with: only the names and settings of its studies are
/// compared.
/// @param asked  Its number; empty: the pinned reference, or else the last passing one that has a
/// study of
///               this nightly run's.
/// @throws InvalidInput if there is no nightly run of that number, or none of this nightly run's
/// studies can be
///         compared with it.
std::optional<int> reference_nightly_run(HistoryStore& store, const NightlyRun& this_run,
                                         std::optional<int> asked);

/// Judges a nightly run that is not yet in the store: sets its reference, findings and verdict.
/// @return What could not be judged, or is only suspected. @throws IoError, InvalidInput.
std::vector<std::string> judge_nightly_run(HistoryStore& store, NightlyRun& this_run,
                                           std::optional<int> asked_reference,
                                           const RegressionRules& rules = {});

/// The most nightly runs in which change points are searched.
inline constexpr int kTrendRuns = 60;

/// Adds this nightly run to a trend of the nightly runs before it. @throws InvalidInput if they
/// have different numbers of values.
void add_this_run(StudyTrend& trend, const NightlyFacts& facts, const NightlyStudy& study);

}  // namespace mapproof
