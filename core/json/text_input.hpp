#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/base/text/words.hpp"

namespace mapproof {

/// The text without its byte order mark, fit to be read as UTF-8.
/// @param first_line  Number of the text's first line, for what is a part of a file; a byte order
///        mark stands in the first alone.
/// @throws IoError with the line for a NUL byte, UTF-16, or bytes that are not UTF-8; or if empty.
std::string_view checked_text(std::string_view text, const std::string& source,
                              std::size_t first_line = 1);

/// "line 7": of the byte at `offset`, counted from `first_line`.
std::string line_of(std::string_view text, std::size_t offset, std::size_t first_line = 1);

/// "line 7, column 12": columns count bytes.
std::string location_of(std::string_view text, std::size_t offset);

/// A decimal number that fills the whole of `cell`, whatever the locale; infinities and NaN by
/// name count as numbers. Empty if it is none, or lies outside the range of a double.
std::optional<double> number_in(std::string_view cell);

/// Why number_in() refuses the cell, or why an infinite one is no good.
std::string number_problem(std::string_view cell);

/// Whether the cell stands for a missing value: nothing, -, or in any case nan, NA, N/A, null,
/// None, NaT and their usual variants.
bool is_missing(std::string_view cell);

/// `cell` in quotes, short enough for an error's line.
std::string in_quotes(std::string_view cell);

}  // namespace mapproof
