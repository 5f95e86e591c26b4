#pragma once

#include <cstddef>

namespace mapproof {

/// The meaning of a colour; a theme defines the colour itself.
enum class ThemeColour {
  kText,
  kMuted,    ///< Helps the eye; still at least 3:1 against the background.
  kFaint,    ///< Of wide lines and areas below others: between kMuted and the background.
  kWarning,  ///< Text about a warning or a failure.
  kSeries1,
  kSeries2,
  kSeries3,
  kSeries4,
  kSeries5,
  kSeries6,
  kSeries7,
  kSeries8,
  kSeries9,
  kSeries10,
};

/// How many colours curves have: kSeries1 to kSeries10.
inline constexpr std::size_t kSeriesCount = 10;

}  // namespace mapproof
