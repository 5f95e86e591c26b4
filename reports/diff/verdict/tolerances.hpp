#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "core/results/quantity.hpp"

namespace mapproof {

/// Tolerances by the id of a quantity, or kOtherNumbers. They replace the defaults.
using Tolerances = std::map<std::string, Tolerance, std::less<>>;

/// The name in the settings of numbers in the records that do not belong to a quantity.
inline constexpr std::string_view kOtherNumbers = "other";

Tolerance tolerance_of(const Quantity& quantity, const Tolerances& changed);

/// The tolerance of numbers that do not belong to a quantity.
Tolerance tolerance_of_others(const Tolerances& changed);

/// Both numbers with as many digits as distinguish them, at least the given count; "none" for NaN.
std::pair<std::string, std::string> distinguished(double baseline, double current, int digits);

/// "0.138 → 0.152 m": as many digits as distinguish the two, at least three.
std::string change_text(double baseline, double current, std::string_view unit);

}  // namespace mapproof
