#pragma once

#include "core/base/files/byte_source.hpp"
#include "core/model/sensor.hpp"
#include "core/records/observations/sources.hpp"

namespace mapproof {

/// Reads a table of landmarks times steps, wide or transposed, row by row. Rows of any length are
/// read, of which one at a time is held in memory, and all numbers as PackedTable keeps them.
/// @throws IoError as read_observations().
/// @note About 20 ns per cell of few digits.
PackedSource read_grid(ByteSource& source, Sensor sensor, const TableFormat& format = {});

}  // namespace mapproof
