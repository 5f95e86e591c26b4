#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "app/folder_report.hpp"
#include "core/model/trial_study.hpp"

namespace mapproof {

/// A study of trials in numbers, for --json: the mean of each quantity for each series and level,
/// and what came out in words.
nlohmann::ordered_json trial_study_result(const TrialStudy& study);

/// What came out, a sentence a line.
std::string trial_study_text(const TrialStudy& study);

/// Reads the records of a folder and makes the figures of them; no solver runs.
/// @param command  The one that makes the study again. @throws IoError.
FolderReport trial_folder_report(const std::filesystem::path& folder, const std::string& command);

}  // namespace mapproof
