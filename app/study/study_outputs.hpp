#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/study/folder_report.hpp"

namespace mapproof {

/// A study in numbers: as a few lines of text, and for --json.
struct StudyNumbers {
  std::string text;
  nlohmann::ordered_json object;
  std::vector<std::string> missing = {};  ///< Data asked for that are not there.
};

/// How a type of study is shown; its study.json has the schema of a StudyKind.
struct StudyOutputs {
  std::string_view study;
  /// Its report with its figures; no solver runs. `command` makes the study again. @throws IoError.
  FolderReport (*report)(const std::filesystem::path& folder, const std::string& command);
  /// @throws IoError.
  StudyNumbers (*numbers)(const std::filesystem::path& folder);
};

/// A file each; a new one is added to study_outputs.cpp.
extern const StudyOutputs kMappingOutputs, kRangeOutputs, kTrialOutputs, kTableOutputs;

/// Those of the study in a folder. @throws IoError if there is none, or if its type is not known.
const StudyOutputs& outputs_of_study(const std::filesystem::path& folder);

}  // namespace mapproof
