#pragma once

#include <filesystem>

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// Reads a log of this form as read_range_log() describes it. Files next to a file are found by its
/// path.
RangeLog read_range_log_text(ByteSource& source, const RangeLogOptions& options);

/// The path of NAME_TD.txt or NAME_DR.txt, packed or not, without that end; empty for others.
std::filesystem::path text_stem(const std::filesystem::path& path);

}  // namespace mapproof
