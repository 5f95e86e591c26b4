#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/diff/verdict/tolerances.hpp"

namespace mapproof {

/// Words with every number, its sign and its power of ten as "#": "MPE 0.2 m" is "MPE # m".
std::string without_numbers(std::string_view text);

/// The numbers of a text, in order; dashes that stand for a minus count as such.
std::vector<double> numbers_in(std::string_view text);

/// How far two texts are apart.
enum class TextChange {
  kNone,     ///< Equal.
  kWithin,   ///< The same words around numbers within tolerance.
  kNumbers,  ///< The same words around other numbers.
  kWords,    ///< Other words, or another number of numbers.
};

TextChange text_change(std::string_view a, std::string_view b, const Tolerance& tolerance);

/// Whether the numbers of both are the same, one by one, whatever words stand between them.
bool same_numbers(std::string_view a, std::string_view b);

}  // namespace mapproof
