#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/history/history_store.hpp"
#include "reports/history/regression_rules.hpp"

namespace mapproof {

/// All rules on one study, their findings dated.
/// @param yesterday  The findings of the night before tonight: what goes on keeps its date.
RuleOutcome judge_study(const StudyEvidence& evidence, const RegressionRules& rules,
                        const std::vector<NightFinding>& yesterday);

/// Whether a night of the store has the study, ordered just as tonight. @throws IoError.
bool has_study(HistoryStore& store, int night, const StudyNight& tonight);

/// The night that tonight is compared with: of its studies name and order are asked for alone.
/// @param asked  Its number; empty: the pinned night, or else the last good one that has a study of
///               tonight's.
/// @throws InvalidInput if there is no night of that number, or none of tonight's studies can be
///         compared with it.
std::optional<int> reference_night(HistoryStore& store, const Night& tonight,
                                   std::optional<int> asked);

/// Judges a night that is not yet in the store: sets its reference, findings and verdict.
/// @return What could not be judged, or is only suspected. @throws IoError, InvalidInput.
std::vector<std::string> judge_night(HistoryStore& store, Night& tonight,
                                     std::optional<int> asked_reference,
                                     const RegressionRules& rules = {});

/// The nights that change points are looked for in, at most.
inline constexpr int kTrendNights = 60;

/// Adds tonight to a trend of the nights before it. @throws InvalidInput if they have different
/// numbers of values.
void add_tonight(StudyTrend& trend, const NightFacts& facts, const StudyNight& study);

}  // namespace mapproof
