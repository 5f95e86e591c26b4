#pragma once

#include <Eigen/Core>

#include "core/model/upgrade_clouds.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// The part of a quadric that points lie about, as a sheet over the plane of its two stronger
/// directions, and lines on it.
struct QuadricSurface {
  Surface sheet;
  Rods lines;  ///< Four rings and eight rays.
};

/// @param cloud  Of at least one finite point.
/// @return Without triangles and lines where the quadric has no such sheet.
QuadricSurface quadric_surface(const QuadricPoints& cloud);

/// Distances of the points from the quadric, to first order: |f| over the length of its gradient.
Eigen::VectorXd quadric_distances(const QuadricPoints& cloud);

}  // namespace mapproof
