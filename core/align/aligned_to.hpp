#pragma once

#include <optional>

#include "core/model/points.hpp"

namespace mapproof {

/// `points` translated, rotated, reflected and scaled to fit `onto` best in least squares, over the
/// rows that both have; empty if those are fewer than three.
/// @param points, onto  M x 2; NaN rows are left out, and stay NaN.
/// @throws InvalidInput if they differ in number.
std::optional<Points> aligned_to(const Points& points, const Points& onto);

/// The same of metric points: translated, rotated and reflected alone.
std::optional<Points> aligned_rigidly_to(const Points& points, const Points& onto);

/// How far `points`, aligned to `onto`, lie from it: root mean square over the rows that both have,
/// in units of that of `onto` about its centre. In [0, 1]; 1 if they cannot be aligned to it.
double relative_gap(const Points& points, const Points& onto);

}  // namespace mapproof
