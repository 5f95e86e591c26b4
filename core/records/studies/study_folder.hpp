#pragma once

#include <filesystem>
#include <string>

namespace mapproof {

/// The files that stand in the folder of every study.
inline constexpr const char* kStudyFile = "study.json";
inline constexpr const char* kTimingsFile = "timings.jsonl";
inline constexpr const char* kResultsFile = "results.csv";

/// Whether the folder holds a study.json.
bool is_study(const std::filesystem::path& folder);

/// @throws IoError if the folder is not there or holds no study.json.
void require_study(const std::filesystem::path& folder);

/// The schema that the folder's study.json says it is of, be the rest readable or not; empty if
/// there is none. @throws IoError.
std::string study_schema(const std::filesystem::path& folder);

}  // namespace mapproof
