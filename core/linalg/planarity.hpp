#pragma once

#include "core/model/points.hpp"

namespace mapproof {

/// Points of a planarity up to this count as lying on one line.
inline constexpr double kFlatPlanarity = 1e-6;

/// How far a set of points is from lying on one line: the smaller singular value of the centred
/// points over the larger one, in [0, 1]; 0 for fewer than 3 points, and for points that coincide.
/// @param points  Finite.
double planarity(const Points& points);

}  // namespace mapproof
