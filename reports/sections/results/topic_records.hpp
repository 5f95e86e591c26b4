#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/model/topic_study.hpp"
#include "core/results/results_study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/study_figures.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {

/// Ends the title of the figure of a map that is of no use.
inline constexpr const char* kNoUsableMap = ": no usable map";

/// The maps of the study of a topic, and the distances of the pairs that they were made of. Maps in
/// which no landmark has a position are named and not drawn.
/// @param prefix  Begins the ids: "missing" gives "missing-map-ID", "missing-pairs-ID".
FigureGroup topic_maps(const TopicStudy& study, const std::string& prefix);

/// The figure that shows what the headline's value is the mean of, with the headline as its title;
/// empty where the figure of its quantity shows it.
/// @param results  labelled_results() of the study.
FigureGroup topic_evidence(const TopicStudy& study, const ResultsStudy& results,
                           const TopicHeadline& headline);

/// Seconds of each series on each data set; empty for a simulated study, or without any.
std::optional<Table> topic_seconds_table(const TopicStudy& study, const std::string& prefix);

/// See incomplete_text().
std::string topic_incomplete(const TopicStudy& study);

/// What was asked for, and what made it.
/// @param command  The one that makes the study and its report again.
std::vector<Block> topic_provenance(const TopicStudy& study, std::span<const Session> sessions,
                                    const std::string& command, const std::string& prefix);

}  // namespace mapproof
