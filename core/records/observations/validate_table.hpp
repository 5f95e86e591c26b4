#pragma once

#include <string>

#include "core/base/byte_source.hpp"

namespace mapproof {

/// Reads a table of whatever kind mapproof knows: long or wide observations, landmarks with
/// positions, a map. The header decides which, or the rows if there is none. What the values of
/// observations are is not told by a table: visibility, bearing and range are tried.
/// @param kind  Set to what it was taken for, before anything is thrown.
/// @throws IoError if it is none, or is broken.
void check_table(ByteSource& source, std::string& kind);

}  // namespace mapproof
