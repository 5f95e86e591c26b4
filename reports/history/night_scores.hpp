#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/model/slam_study.hpp"
#include "core/model/study.hpp"
#include "core/model/trial_study.hpp"
#include "reports/history/night.hpp"

namespace mapproof {

/// Every score of a study of the mapping methods, and the seconds of each piece. Variations are
/// series of their own: "isomap-K6 anchor-count=5".
Scores night_scores(const Study& study, std::span<const Timing> timings);

/// Every score of a range-only study: paths and landmarks of each log, convergence, maps of ranges;
/// seconds of each method.
Scores night_scores(const SlamStudy& study, const SlamTimings& timings);
Scores night_scores(const TrialStudy& study);

/// What nights are compared by: the SHA-256 of a study.json without what made it, which leaves the
/// experiment as it was ordered. @throws IoError if the text is no JSON.
std::string order_digest(const std::string& study_json, const std::string& source);

/// The study in a folder as a night keeps it, its figures apart. @throws IoError.
StudyNight read_study_night(const std::filesystem::path& folder, const std::string& name);

}  // namespace mapproof
