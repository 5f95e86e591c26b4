#pragma once

#include <filesystem>
#include <string>

#include "core/base/files/byte_source.hpp"
#include "core/records/ranges/gathered_range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"
#include "core/records/tables/column_names.hpp"

namespace mapproof {

/// The files that go with ranges, whatever the form of the ranges: tables of odometry, of its start
/// and of a true path, and true positions of landmarks. All throw IoError as read_range_log().
///
/// @param columns  Those that the user names; each that a table has is marked as found.
std::vector<Motion> read_motions(const std::filesystem::path& path, ColumnNames& columns);
StartPose read_start(const std::filesystem::path& path, ColumnNames& columns);
/// @param times_s  Of the poses of the odometry, for a path without times.
Trajectory read_true_path(ByteSource& source, const Eigen::VectorXd& times_s, ColumnNames& columns);
NamedPoints read_true_landmarks(ByteSource& source, ColumnNames& columns);

/// Reads the files that the options name in place of what was gathered.
void take_named_files(const RangeLogOptions& options, RangeLogParts& parts);

/// Whether a file of ground truth, which stays unread, holds positions of landmarks rather than a
/// path: its header names landmarks, or it has three columns without a time.
bool holds_landmarks(ByteSource& source, const ColumnNames& columns = {});

/// What goes with ranges.
enum class Companion { kOdometry, kPath, kLandmarks };

/// Reads a file as what it is stated to be. @return Its kind: "odometry", "path, TUM".
std::string check_range_companion(ByteSource& source, Companion companion,
                                  const ColumnNames& columns);

/// Reads a file that its first row shows to be odometry or a path, as TUM and KITTI have it too.
/// @return What it is. Empty: it is none of them, and unread.
std::string check_range_companion(ByteSource& source, const ColumnNames& columns = {});

}  // namespace mapproof
