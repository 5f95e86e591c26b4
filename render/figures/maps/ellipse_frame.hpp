#pragma once

#include <optional>
#include <string_view>

#include "render/plot/axis_map.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// The limits with all of the ellipses, as far as half the width of `limits` beyond them: one huge
/// ellipse must not make all the rest small.
/// @param ellipses  Finite.
PanelLimits with_ellipses(const PanelLimits& limits, const Ellipses& ellipses);

/// "2 ellipses beyond the frame; half the longest axis, of b, is 2448 m."; nothing if the limits
/// cut none.
/// @param ellipses  Their marks name the landmarks.
/// @param unit      Of their axes, " m"; empty: arbitrary.
/// @param enlarged  The factor by which they are drawn larger than they are.
std::optional<Note> cut_ellipses_note(const Ellipses& ellipses, const PanelLimits& limits,
                                      std::string_view unit, double enlarged = 1.0);

}  // namespace mapproof
