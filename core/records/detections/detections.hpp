#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/files/byte_source.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/points.hpp"
#include "core/model/sensor.hpp"
#include "core/records/detections/scan_rows.hpp"
#include "core/records/observations/sources.hpp"

namespace mapproof {

/// Long CSV, as read_detections() has it.
DetectionSource read_long_detections(ByteSource& source, const TableFormat& format);

/// Detections from long CSV or mapproof's JSON (mapproof.detections).
///
/// A row of CSV is a landmark in a scan: step or time, landmark, range, bearing, where a scan's
/// rows have one step or time; a robot's name too, whose scans are then its own. The columns are
/// recognised by their names, in any case and order; without a header they are step, landmark,
/// range, bearing. Columns of other names are not read, and remarked. The scans are pooled robot by
/// robot in order of step or time. Cells may be empty: not measured.
/// @throws IoError naming file and line if a number is out of its bounds (|rad| <= 2 pi or |deg| <=
///         360; 0 <= m <= 1e6), a landmark is twice in one scan, or for more than 5000 landmarks,
///         1e6 scans or 5e7 rows.
/// @note A row takes 24 bytes while it is read and after; the text is never held as a whole.
DetectionSource read_detections(ByteSource& source, const TableFormat& format = {});

/// The same of a file or stream, or of a folder of MRCLAM [leung2011].
DetectionSource read_detections(const std::filesystem::path& path, const TableFormat& format = {});

/// Whether a source, which stays unread, holds detections: JSON of that schema, or a table whose
/// header names a landmark and a range or bearing, or when each was seen and nothing else.
/// @throws IoError if it cannot be read.
bool is_detections(ByteSource& source, const TableFormat& format = {});

/// What a source of detections, which stays unread, measures: range, bearing, both; neither: it
/// lists what was seen.
MeasuredColumns measured_in(ByteSource& source, const TableFormat& format = {});

/// Whether a source, which stays unread, is a long table, of detections or of values, and its text
/// larger than some 64 MB. @throws IoError if it cannot be read.
bool is_large_long_table(ByteSource& source, const TableFormat& format = {});

}  // namespace mapproof
