#pragma once

#include "core/base/files/byte_source.hpp"
#include "core/model/range_log.hpp"
#include "core/records/ranges/range_log_options.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// Reads a log of this form as read_range_log() describes it. Files next to a file are found by its
/// path.
RangeLog read_range_log_pyfg(ByteSource& source, const RangeLogOptions& options);

}  // namespace mapproof
