#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/model/trial_study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// The maps of a study of trials, and the distances of the pairs that they were made of.
/// @param prefix  Begins the ids: "missing" gives "missing-map-ID", "missing-pairs-ID".
FigureGroup trial_maps(const TrialStudy& study, const std::string& prefix);

/// Seconds of each series on each data set; empty for a simulated study, or without any.
std::optional<Table> trial_seconds_table(const TrialStudy& study, const std::string& prefix);

/// "2 of 5 runs are done; ..."; empty if all are.
std::string trial_incomplete(const TrialStudy& study);

/// What was asked for, and what made it.
/// @param command  The one that makes the study and its report again.
std::vector<Block> trial_provenance(const TrialStudy& study, std::span<const Session> sessions,
                                    const std::string& command, const std::string& prefix);

}  // namespace mapproof
