#include "render/figures/maps/path_styles.hpp"

#include <algorithm>

namespace mapproof {

PathStyle path_style(SlamMethod method) {
  switch (method) {
    case SlamMethod::kDeadReckoning:
      return {Ink::kSeries4, Dash::kDashed, 0.7, Marker::kTriangle};
    case SlamMethod::kEkf:
      return {Ink::kSeries6, Dash::kDashDot, 0.8, Marker::kTriangleDown};
    case SlamMethod::kSpectralKnown:
      return {Ink::kSeries3, Dash::kDashed, 0.9, Marker::kCross};
    case SlamMethod::kSpectralKnown7:
      return {Ink::kSeries3, Dash::kDotted, 0.9, Marker::kCross};
    case SlamMethod::kSpectral:
      return {Ink::kSeries1, Dash::kSolid, 0.9, Marker::kPlus};
    case SlamMethod::kSpectral7:
      return {Ink::kSeries1, Dash::kDotted, 0.9, Marker::kPlus};
    case SlamMethod::kBatchFixedScale:
      return {Ink::kSeries5, Dash::kDashDot, 0.8, Marker::kDiamond};
    case SlamMethod::kRefined:
      return {Ink::kSeries2, Dash::kSolid, 0.7, Marker::kCross};
    case SlamMethod::kRefinedFromOdometry:
      return {Ink::kSeries4, Dash::kLongDash, 0.7, Marker::kSquare};
    case SlamMethod::kRefinedFromRandom:
      return {Ink::kSeries6, Dash::kDotted, 0.7, Marker::kDiamond};
    case SlamMethod::kRepaired:
      return {Ink::kSeries5, Dash::kSolid, 0.7, Marker::kSquare};
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
