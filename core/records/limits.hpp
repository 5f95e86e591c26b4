#pragma once

#include <cstddef>

namespace mapproof {

/// Sizes beyond which an input is taken for a mistake.
inline constexpr int kMostLayouts = 10'000;
inline constexpr int kMostPoses = 10'000;  ///< In each layout.
inline constexpr long kMostRuns = 1'000'000;
inline constexpr int kMostLandmarks = 1'000'000;       ///< Of maps and observations.
inline constexpr int kMostRangeLandmarks = 5000;       ///< Of range logs.
inline constexpr int kMostSteps = 1'000'000;
inline constexpr double kMostEntries = 2e8;          ///< Of an observation history.
inline constexpr double kFarthest_m = 1e9;           ///< Coordinates.
inline constexpr double kLeastMedianRange_m = 1e-6;  ///< Of a range log, zeros left out.
inline constexpr double kLongestRange_m = 1e6;
inline constexpr std::size_t kLongestName = 65'536;
/// Of what the program itself wrote: a command, or a sentence that lists names, may be long.
inline constexpr std::size_t kLongestText = 100'000'000;

}  // namespace mapproof
