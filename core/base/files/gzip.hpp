#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// The bytes packed by gzip, without a name and a time: equal bytes give equal ones. Unpacker reads
/// them.
/// @throws std::bad_alloc if there is no memory for twice the bytes.
std::string gzipped(std::string_view bytes);

}  // namespace mapproof
