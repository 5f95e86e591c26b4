#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// "1 run", "25 runs", "25,700 runs" (see count_text).
std::string counted(long long count, std::string_view noun);

/// A to Z as small letters, all else as it is.
std::string lower_case(std::string_view text);

/// With A to Z for a to z at its start, as a sentence begins.
std::string capitalised(std::string text);

/// What C's isspace() takes for blank in any locale.
inline constexpr std::string_view kWhiteSpace = " \t\r\n\f\v";

/// Without `blanks` at both ends: without spaces, tabs and carriage returns.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t\r");

/// "a", "a and b", "a, b and c"; of more than `most` names, most - 1 and how many
/// more: "a, b and 5 more".
std::string listed(const std::vector<std::string>& names, std::size_t most);

}  // namespace mapproof
