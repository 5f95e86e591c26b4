#pragma once

#include <cstddef>
#include <string>

#include "reports/model/report.hpp"

namespace mapproof {

/// Draws a ring around the points of a curve that got worse, in a drawing as figure_svg() writes
/// it: around all markers, or those at some values of x. A drawing without the curve, or without a
/// marker there, stays as it is.
/// @return How many rings it drew.
std::size_t mark_curve(const RegressedCurve& curve, std::string& svg);

}  // namespace mapproof
