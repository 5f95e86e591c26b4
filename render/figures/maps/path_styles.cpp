#include "render/figures/maps/path_styles.hpp"

#include <algorithm>

namespace mapproof {

PathStyle path_style(SlamMethod method) {
  switch (method) {
    case SlamMethod::kDeadReckoning:
      return {ThemeColour::kSeries4, Dash::kDashed, 0.7, Marker::kTriangle};
    case SlamMethod::kEkf:
      return {ThemeColour::kSeries6, Dash::kDashDot, 0.8, Marker::kTriangleDown};
    case SlamMethod::kSpectralKnown:
      return {ThemeColour::kSeries3, Dash::kDashed, 0.9, Marker::kCross};
    case SlamMethod::kSpectralKnown7:
      return {ThemeColour::kSeries3, Dash::kDotted, 0.9, Marker::kCross};
    case SlamMethod::kSpectral:
      return {ThemeColour::kSeries1, Dash::kSolid, 0.9, Marker::kPlus};
    case SlamMethod::kSpectral7:
      return {ThemeColour::kSeries1, Dash::kDotted, 0.9, Marker::kPlus};
    case SlamMethod::kBatchFixedScale:
      return {ThemeColour::kSeries5, Dash::kDashDot, 0.8, Marker::kDiamond};
    case SlamMethod::kRefined:
      return {ThemeColour::kSeries2, Dash::kSolid, 0.7, Marker::kCross};
    case SlamMethod::kRefinedFromOdometry:
      return {ThemeColour::kSeries4, Dash::kLongDash, 0.7, Marker::kSquare};
    case SlamMethod::kRefinedFromRandom:
      return {ThemeColour::kSeries6, Dash::kDotted, 0.7, Marker::kDiamond};
    case SlamMethod::kRepaired:
      return {ThemeColour::kSeries5, Dash::kSolid, 0.7, Marker::kSquare};
  }
  return {};
}

std::string alignment_words(Alignment alignment) {
  if (alignment == Alignment::kNone) return "unaligned";
  std::string text(name(alignment));
  std::ranges::replace(text, '-', ' ');
  return text;
}

}  // namespace mapproof
