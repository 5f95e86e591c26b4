#pragma once

#include <string>

#include "core/base/files/byte_source.hpp"

namespace mapproof {

/// Whether an input is JSON, by its first character; by its name too, so that one that is broken
/// there is reported as JSON. It stays unread.
bool is_json(ByteSource& source);

/// The name of a JSON input's schema, empty if it names none. It stays unread.
/// @note Scans no further than the name, which mostly comes first.
std::string json_schema(ByteSource& source);

}  // namespace mapproof
