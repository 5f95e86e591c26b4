#pragma once

#include <filesystem>
#include <string>

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"

namespace mapproof {

/// Odometry and ranges of one robot [djugash2009], with the ground truth if it is there, from
///
/// - CSV of ranges (time, landmark, range). Of a folder, or the file ranges.csv in it: ranges.csv
///   and, if they are there, odometry_drp.csv with odometry_drp_start.csv or else odometry.csv with
///   odometry_start.csv, groundtruth.csv, landmarks.csv;
/// - MATLAB 5 to 7.2: TD (time, sender, landmark, range) and, if they are there, DR (time,
///   distance, heading change), DRp and GT (time, x, y, heading), TL (landmark, x, y);
/// - TD as text, four numbers a row; of the files NAME_TD.txt or NAME_DR.txt with the other next to
///   it, DR too;
/// - PyFactorGraph: VERTEX_SE2, VERTEX_XY, EDGE_SE2, EDGE_RANGE.
///
/// The first bytes determine which; a file's name helps where they are wrong, so that the error is
/// about what it was meant to be. Files may be packed. What was sorted, turned, recovered, left out
/// or is not to be trusted stands in `remarks`.
/// @throws IoError naming file and line (or variable and row) if the source cannot be read as such,
///         holds a number that is not finite or beyond any map, or shows more than one robot.
/// @note Linear in the size of the files, but for sorting.
RangeLog read_range_log(const std::filesystem::path& path, const RangeLogOptions& options = {});
RangeLog read_range_log(ByteSource& source, const RangeLogOptions& options = {});

/// Whether a folder holds ranges.csv. A table of that name may be of another kind.
bool is_range_log_folder(const std::filesystem::path& folder);

/// Whether a source, which stays unread, is one of the forms above that nothing else is: not four
/// numbers a row, and of tables that could be detections as well ranges.csv alone.
/// @throws IoError if it cannot be read.
bool is_range_log(ByteSource& source, const ColumnNames& columns = {});

}  // namespace mapproof
