#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "reports/diff/verdict/tolerances.hpp"

namespace mapproof {

/// A text with every number, its sign and its power of ten replaced by "#": "MPE 0.2 m" becomes
/// "MPE # m".
std::string without_numbers(std::string_view text);

/// The numbers of a text, in order; dashes used as a minus count as one.
std::vector<double> numbers_in(std::string_view text);

/// Both texts with their longest decimal numbers in as few digits as distinguish them:
/// "0 to 0.17021583813709998" is "0 to 0.170". Numbers of up to eight characters stay.
std::pair<std::string, std::string> readable_numbers(std::string_view a, std::string_view b);

/// The difference of two texts.
enum class TextChange {
  kNone,     ///< Equal.
  kWithin,   ///< Equal words, numbers within tolerance.
  kNumbers,  ///< Equal words, numbers beyond tolerance.
  kWords,    ///< Different words, or different counts of numbers.
};

TextChange text_change(std::string_view a, std::string_view b, const Tolerance& tolerance);

/// Whether the numbers of both are equal, one by one, whatever words are between them.
bool same_numbers(std::string_view a, std::string_view b);

}  // namespace mapproof
