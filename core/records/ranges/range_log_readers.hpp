#pragma once

#include <filesystem>

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// The readers of the several forms, as read_range_log() describes them. Files next to a file
/// are found by its path.
RangeLog read_range_log_csv(ByteSource& source, const RangeLogOptions& options);
RangeLog read_range_log_mat(ByteSource& source, const RangeLogOptions& options);
RangeLog read_range_log_pyfg(ByteSource& source, const RangeLogOptions& options);
RangeLog read_range_log_text(ByteSource& source, const RangeLogOptions& options);

/// Whether a table's first row names the columns of ranges: time, landmark, range.
bool names_range_columns(const TableRow& row);

/// The path of NAME_TD.txt or NAME_DR.txt, packed or not, without that end; empty for others.
std::filesystem::path text_stem(const std::filesystem::path& path);

}  // namespace mapproof
