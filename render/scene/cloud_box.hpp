#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "render/scene/scene.hpp"

namespace mapproof {

/// An upright box about a cloud of points: what axes of a scene without a room stand on.
struct CloudBox {
  Point3 low = Point3::Zero();
  Point3 high = Point3::Zero();

  /// About all points, a little wider; never flat.
  explicit CloudBox(std::span<const Point3> points);

  double size() const { return (high - low).norm(); }
  std::array<Point3, 8> corners() const;
  /// Its lower side.
  Surface floor() const;
  /// The twelve edges as thin rods.
  Rods edges() const;
  /// Axes along the three edges that a camera to the south-east of the box, above it, sees first.
  std::vector<Rule> rules(const std::array<std::string, 3>& labels) const;
  /// Such a camera, with room for the labels of the axes.
  /// @param direction  To the camera.
  /// @param aspect     Of the image: that of boxes side by side.
  Camera camera(const Point3& direction, double aspect) const;
  /// As above, with an image of the proportions of the box.
  Camera camera(const Point3& direction) const;

 private:
  /// What an image shows: the box, and the ends of its axes moved towards their labels.
  std::vector<Point3> shown() const;
};

}  // namespace mapproof
