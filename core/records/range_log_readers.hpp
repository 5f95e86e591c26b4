#pragma once

#include <filesystem>

#include "core/records/range_log_files.hpp"

namespace mapproof {

/// The readers of the several forms, as read_range_log() describes them.
RangeLog read_range_log_csv(const std::filesystem::path& folder, const RangeLogOptions& options);
RangeLog read_range_log_mat(const std::filesystem::path& path, const RangeLogOptions& options);
RangeLog read_range_log_pyfg(const std::filesystem::path& path, const RangeLogOptions& options);
/// @param stem  The path without _DR.txt or _TD.txt.
RangeLog read_range_log_text(const std::filesystem::path& stem, const RangeLogOptions& options);

/// Whether a CSV file names the columns of ranges: time, landmark, range. False if it cannot be
/// read.
/// @note Reads the start of the file alone.
bool has_range_columns(const std::filesystem::path& path);

}  // namespace mapproof
