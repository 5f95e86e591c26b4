#pragma once

#include <string>
#include <string_view>

namespace mapproof {

/// "1.5 m": number and unit with a no-break space (U+00A0) between them, so that no line ends
/// there; "5°" without one, and the number alone if the unit is empty.
std::string with_unit(std::string_view number, std::string_view unit);

/// A text with plain spaces in place of no-break ones, for files that other programs read.
std::string with_plain_spaces(std::string text);

}  // namespace mapproof
