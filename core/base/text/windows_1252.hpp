#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace mapproof {

/// Offset of the first byte beyond ASCII; text.size() if there is none.
std::size_t ascii_length(std::string_view text);

/// Whether a text is to be taken as Windows-1252, as spreadsheets of Windows write it: the first
/// character beyond ASCII is not UTF-8.
/// @param text  Its last characters may be cut off: those do not count.
bool is_windows_1252(std::string_view text);

/// Windows-1252 as UTF-8. Of ISO 8859-1 it differs in control characters alone. The five bytes
/// that it does not define stay as they are, and are not UTF-8.
std::string from_windows_1252(std::string_view text);

}  // namespace mapproof
