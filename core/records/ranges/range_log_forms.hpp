#pragma once

#include <filesystem>

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

struct RangeLogParts;

/// The register of the forms that read_range_log() describes; range_log_NAME.cpp reads the form
/// NAME. Files next to a file are found by its path.
RangeLog read_range_log_csv(ByteSource& source, const RangeLogOptions& options);
RangeLog read_range_log_mat(ByteSource& source, const RangeLogOptions& options);
RangeLog read_range_log_pyfg(ByteSource& source, const RangeLogOptions& options);
RangeLog read_range_log_text(ByteSource& source, const RangeLogOptions& options);

/// Whether a table's first row names the columns of ranges: time, landmark, range. Of the form csv.
bool names_range_columns(const TableRow& row);

/// The path of NAME_TD.txt or NAME_DR.txt, packed or not, without that end; empty for others. Of
/// the form text.
std::filesystem::path text_stem(const std::filesystem::path& path);

/// Reads the files that the options name in place of what was gathered. @throws IoError.
void take_named_files(const RangeLogOptions& options, RangeLogParts& parts);

}  // namespace mapproof
