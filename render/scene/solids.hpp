#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/scene/scene.hpp"

namespace mapproof {

/// Triangles with a normal a point, their corners counter-clockwise as seen from outside.
struct TriangleMesh {
  std::vector<Point3> points;
  std::vector<Point3> normals;  ///< Outward, of length 1.
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Adds a bar with flat ends, of `sides` sides shaded round. Nothing where from and to are one.
void add_rod(TriangleMesh& mesh, const Point3& from, const Point3& to, double radius, int sides);

/// As add_rod, with a head that ends at `to`: 3 times as wide, 4 radii long or all of it if the
/// arrow is shorter.
void add_arrow(TriangleMesh& mesh, const Point3& from, const Point3& to, double radius, int sides);

void add_sphere(TriangleMesh& mesh, const Point3& at, double radius, int sides);

}  // namespace mapproof
