#pragma once

#include <filesystem>

#include "reports/diff/diff_result.hpp"
#include "reports/diff/diff_settings.hpp"

namespace mapproof {

/// Compares two studies with their figures, two folders of pictures, or two files (pictures,
/// figures as JSON, map.json, slam.json).
/// @throws IoError if one of them is not there or cannot be listed; InvalidInput if there is
/// nothing
///         to compare, or two things of different kinds.
/// @note Several pictures at a time, by oneTBB; the result does not depend on it.
DiffResult folder_diff(const std::filesystem::path& baseline, const std::filesystem::path& current,
                       const DiffSettings& settings = {});

/// What is said of a current folder where there is no baseline: all of it is new, the baseline
/// missing. Never passes, whatever is allowed.
/// @throws IoError as folder_diff.
DiffResult no_baseline(const std::filesystem::path& baseline, const std::filesystem::path& current,
                       const DiffSettings& settings);

}  // namespace mapproof
