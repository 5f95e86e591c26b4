#pragma once

#include <string>

#include "core/base/text/words.hpp"

namespace mapproof {

/// `value` with so many significant digits, never in scientific notation below 1e6.
std::string significant(double value, int digits = 3);

/// `value` with so many decimals. Where these would show zeros alone of a value that is none, it is
/// "≈ 0"; with six decimals or more, which a quantity of small values has, significant digits.
std::string rounded_text(double value, int decimals, int digits = 3);

/// An error with its unit, "0.123 m"; of a map that diverged "over 1 km" (see kGreatestError_m).
std::string error_text(double error_m, int digits = 3);

/// A time with its unit, two significant digits: "310 µs", "0.3 ms", "12 s".
std::string seconds_text(double seconds);

/// A number for a data attribute: six significant digits, "." for the point.
std::string data_number(double value);

}  // namespace mapproof
