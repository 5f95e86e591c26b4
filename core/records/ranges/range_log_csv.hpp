#pragma once

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// Reads a log of this form as read_range_log() describes it. Files next to a file are found by its
/// path.
RangeLog read_range_log_csv(ByteSource& source, const RangeLogOptions& options);

/// Whether a table's first row names the columns of ranges: time, landmark, range.
bool names_range_columns(const TableRow& row);

}  // namespace mapproof
