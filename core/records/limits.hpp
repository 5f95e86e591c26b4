#pragma once

#include <cstddef>

namespace mapproof {

/// Sizes beyond which an input is taken for a mistake.
inline constexpr int kMostLandmarks = 5000;
inline constexpr int kMostSteps = 1'000'000;
inline constexpr double kMostEntries = 2e8;  ///< Of an observation history.
inline constexpr double kFarthest_m = 1e9;   ///< Coordinates.
inline constexpr double kLongestRange_m = 1e6;
inline constexpr std::size_t kLongestName = 65'536;

}  // namespace mapproof
