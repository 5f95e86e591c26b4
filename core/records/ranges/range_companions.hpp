#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

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

/// What was understood of such a file, in numbers.
struct CompanionSummary {
  std::string kind;  ///< "path, TUM"; empty: it is none of them, and unread.
  Companion companion = Companion::kLandmarks;
  Eigen::Index rows = 0;                  ///< Motions, poses or landmarks.
  double duration_s = 0.0;                ///< From the first motion or pose to the last.
  double way_m = 0.0;                     ///< That motions or poses go.
  double turned_rad = 0.0;                ///< Sum of the motions' heading changes, as they are.
  Eigen::Vector2d extent_m = {0.0, 0.0};  ///< Of poses or landmarks along x and y.
  bool has_headings = false;              ///< Of poses.
  /// Role and header of each column that was read.
  std::vector<std::pair<std::string, std::string>> columns = {};
  std::vector<std::string> remarks = {};  ///< What looks unusual, a sentence each.
};

/// Reads a file as what it is stated to be.
CompanionSummary read_companion(ByteSource& source, Companion companion,
                                const ColumnNames& columns);

/// Reads a file that its first row shows to be odometry or a path, as TUM and KITTI have it too.
CompanionSummary read_companion(ByteSource& source, const ColumnNames& columns = {});

}  // namespace mapproof
