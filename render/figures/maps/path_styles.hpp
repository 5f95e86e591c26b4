#pragma once

#include <string>

#include "core/model/slam/slam_study.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// The style of a method's path, errors and landmarks, the same in all figures.
struct PathStyle {
  ThemeColour colour = ThemeColour::kSeries1;
  Dash dash = Dash::kSolid;  ///< Of errors over time; paths are solid, being dense.
  double width = 1.0;        ///< Of paths.
  Marker marker = Marker::kPlus;
};
PathStyle path_style(SlamMethod method);

/// The colour class of the ground truth: wide and grey, so that what lies on it is seen.
inline constexpr ThemeColour kTrueColour = ThemeColour::kMuted;

/// "unaligned", "rigid", "rigid with reflection", "similarity": how an error was taken, in
/// words.
std::string alignment_words(Alignment alignment);

}  // namespace mapproof
