#pragma once

#include <map>
#include <string>

#include "core/base/byte_source.hpp"
#include "core/records/ranges/range_tables.hpp"

namespace mapproof {

/// The tables of real doubles in a MATLAB 5 file (that of MATLAB 5 to 7.2), by the name of their
/// variable. Variables of other kinds are passed over.
///
/// @throws IoError naming the variable if the file is of another version, cut off or damaged; if a
///         table has more than 1e6 rows or 16 columns; or if a number is not finite.
/// @note The frame of the file is checked here, since matio trusts it.
std::map<std::string, NumberTable> read_mat_tables(ByteSource& input);

}  // namespace mapproof
