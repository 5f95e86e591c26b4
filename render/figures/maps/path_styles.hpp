#pragma once

#include <string>

#include "core/model/slam/slam_study.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// The style of a method's path, errors and landmarks, the same in all figures.
struct PathStyle {
  ThemeColour colour = ThemeColour::kSeries1;
  Dash dash = Dash::kSolid;  ///< Of paths and of errors over time.
  double width = 1.0;        ///< Of paths.
  Marker marker = Marker::kPlus;
};
PathStyle path_style(SlamMethod method);

/// The ground truth is light and wide, so that what lies on it is seen, and it as well.
inline constexpr ThemeColour kTrueColour = ThemeColour::kFaint;
inline constexpr double kTrueWidth = 3.0;  ///< Of its path, in lines of the theme.

/// "unaligned", "rigid", "rigid with reflection", "similarity": how an error was taken, in
/// words.
std::string alignment_words(Alignment alignment);

}  // namespace mapproof
