#pragma once

#include <limits>
#include <string_view>

namespace mapproof {

/// The greatest error that pages and figures print as a number, m: a map that is farther off
/// diverged, and by how much says nothing.
inline constexpr double kGreatestError_m = 1000.0;

/// The same in the unit of an error; infinite of a unit other than m and mm.
constexpr double greatest_error(std::string_view unit) {
  return unit == "m"    ? kGreatestError_m
         : unit == "mm" ? 1e3 * kGreatestError_m
                        : std::numeric_limits<double>::infinity();
}

/// What is said of a greater error, and of a difference below its negative.
inline constexpr const char* kGreatErrorText = "over 1\u00A0km";
inline constexpr const char* kGreatGainText = "below \u22121\u00A0km";

}  // namespace mapproof
