#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "render/theme/theme.hpp"
#include "reports/html/templates.hpp"
#include "reports/sections/study_figures.hpp"

namespace mapproof {

/// A study as it was read from its folder, with its figures as values.
struct StudyView {
  std::filesystem::path folder;
  Study study;
  std::vector<Timing> timings;
  StudyFigures figures;
};

/// Reads the records of a folder and makes the figures of them; no solver runs.
/// @throws IoError.
StudyView view_study(const std::filesystem::path& folder);

/// Draws the figures into `folder`, several at a time; no two may have one id.
/// @return The text of each SVG file by its figure's id. @throws IoError.
std::map<std::string, std::string> write_figures(const std::vector<const Figure*>& figures,
                                                 const Theme& theme,
                                                 const std::filesystem::path& folder, int jobs);

/// Writes figures/, tables/ and report.html beside the records.
/// @param command  The one that makes the study again.
/// @return The path of the report.
std::filesystem::path write_report(const StudyView& view, const std::string& command,
                                   const Templates& page, int jobs);

}  // namespace mapproof
