#pragma once

#include <filesystem>
#include <string>

#include "app/folder_report.hpp"

namespace mapproof {

/// The report of a study that is a table of results. @throws IoError.
FolderReport results_folder_report(const std::filesystem::path& folder, const std::string& command);

}  // namespace mapproof
