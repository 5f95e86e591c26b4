#pragma once

#include <span>

#include "render/base/geometry.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// From space to the image: x in [-aspect, aspect] to the right, y in [-1, 1] upward are inside.
class Projection {
 public:
  /// @param camera  One that `problem(scene)` has nothing against.
  explicit Projection(const Camera& camera);

  /// NaN for what is at or behind the eye of a perspective camera.
  Point operator()(const Point3& position) const;
  /// How large a length at `at`, across the line of sight, is in the image; NaN as above.
  double size_at(const Point3& position, double length) const;
  /// Along the line of sight from the eye.
  double depth(const Point3& position) const { return (position - eye_).dot(forward_); }

  Point3 right() const { return right_; }
  Point3 upward() const { return up_; }

 private:
  double units_per_length(const Point3& position) const;

  Point3 eye_, forward_, right_, up_;
  bool parallel_;
  double half_;  ///< Half the height, at the depth 1 of a perspective camera.
};

/// A camera that looks along -`from` and shows all `points` with a margin, as large as they fit.
/// @param from   Direction of the eye as seen from the points; any length above 0, not along z for
///               an upright image (plan views then have y upward).
/// @throws InvalidInput without points.
Camera fitted_camera(std::span<const Point3> points, const Point3& from, bool parallel,
                     double aspect = 1.6, double margin = 0.06);

/// As fitted_camera(), with an image of the proportions of what it shows, from 0.9 to 2.6: no side
/// of it is empty.
/// @param aspect  Of the image from which the proportions are taken.
Camera tight_camera(std::span<const Point3> points, const Point3& from, bool parallel,
                    double aspect);

}  // namespace mapproof
