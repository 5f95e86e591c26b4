#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "core/results/quantity.hpp"

namespace mapproof {

/// Tolerances by the id of a quantity, or kOtherNumbers, in place of its own.
using Tolerances = std::map<std::string, Tolerance, std::less<>>;

/// What settings call the numbers of the records that are not quantity's.
inline constexpr std::string_view kOtherNumbers = "other";

Tolerance tolerance_of(const Quantity& quantity, const Tolerances& changed);

/// Of the numbers that are not quantity's.
Tolerance tolerance_of_others(const Tolerances& changed);

/// Both in as many digits as tell the two apart, at least so many; "none" for what is not a number.
std::pair<std::string, std::string> told_apart(double baseline, double current, int digits);

/// "0.138 → 0.152 m": as many digits as tell the two apart, at least three.
std::string change_text(double baseline, double current, std::string_view unit);

}  // namespace mapproof
