#pragma once

#include <filesystem>
#include <string>

#include "app/study/folder_report.hpp"
#include "core/model/slam_study.hpp"

namespace mapproof {

/// The report of a range-only study that is at hand, with its figures.
/// @param command  The one that makes the study again.
FolderReport slam_folder_report(const std::filesystem::path& folder, const SlamStudy& study,
                                const SlamTimings& timings, std::span<const Session> sessions,
                                const std::string& command);

}  // namespace mapproof
