#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/folder_report.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// A study of the mapping methods as it was read from its folder, with its figures as values.
struct StudyView {
  std::filesystem::path folder;
  Study study;
  std::vector<Timing> timings;
  StudyFigures figures;
};

/// Reads the records of a folder and makes the figures of them; no solver runs.
/// @throws IoError.
StudyView view_study(const std::filesystem::path& folder);

/// @param command  The one that makes the study again. @throws IoError.
FolderReport study_folder_report(const StudyView& view, const std::string& command);

}  // namespace mapproof
