#pragma once

#include <cstddef>
#include <string>

namespace mapproof {

/// The most characters of an id of a section, a figure or a table; files are named by it.
inline constexpr std::size_t kLongestId = 100;

/// [a-z0-9-]+ of any text, for ids: letters and digits, each run of others as one hyphen; none at
/// either end. At most 60 characters, as bounded_id() has them. Empty if the text has neither.
std::string slug_of(const std::string& text);

/// The id; if it is longer than `most` characters, cut, with eight digits that tell it from others.
/// @param most  10 or more.
std::string bounded_id(std::string id, std::size_t most);

}  // namespace mapproof
