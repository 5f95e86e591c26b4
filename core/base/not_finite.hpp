#pragma once

#include <limits>

namespace mapproof {

/// A number that is missing, lost or not known.
inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace mapproof
