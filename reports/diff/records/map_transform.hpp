#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/model/points.hpp"

namespace mapproof {

/// A similarity transformation that moved all points of a map together.
struct MapTransform {
  long points = 0;
  bool is_mirrored = false;
  double angle_rad = 0.0;  ///< Counter-clockwise; of a mirrored map it depends on the mirror.
  double scale = 1.0;
  double shift = 0.0;   ///< Of the centroid, in the unit of the points.
  double spread = 0.0;  ///< Root mean square distance of the points from their centroid.
};

/// The transformation from one set of points to another [umeyama1991], if it explains how they
/// moved: what it leaves is at most 1 % of the movement, as root mean squares over the points.
/// @param from, to  n x 2, row by row the same point; rows with NaN in either are left out.
/// @return None for fewer than three points, or if no transformation explains the movement.
std::optional<MapTransform> map_transform(const Points& from, const Points& to);

/// "the map of 50 landmarks is mirrored", "... is rotated by 90° and scaled by 1.1", "... is
/// shifted by 0.2 m"; "all 200 points are mirrored" of other points than landmarks.
/// @param noun  Of one point: "landmark".
/// @param unit  Of a shift; empty: none.
std::string transform_text(const MapTransform& transform, std::string_view noun,
                           std::string_view unit);

}  // namespace mapproof
