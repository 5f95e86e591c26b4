#pragma once

#include <span>
#include <string_view>

namespace mapproof {

/// The candidate with the least edit distance to the first 64 bytes of `word`; empty if there is
/// none. Ties go to the earlier one.
std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates);

/// The same, but empty unless the words are near enough to be a slip of the hand, or a candidate
/// goes on from the word: "mpe_m" from "mpe", "path-own" from "path", "yairi2007" from "yairi".
std::string_view likely_word(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace mapproof
