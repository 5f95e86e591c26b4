#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// The bytes packed by gzip, as small as zlib makes them, without a name and a time: equal bytes
/// give equal ones. Unpacker reads them.
std::string gzipped(std::string_view bytes);

}  // namespace mapproof
