#include "render/scene/solids.hpp"

#include <cmath>
#include <numbers>
#include <span>

namespace mapproof {
namespace {

/// A piece of the outline that turns about the axis, and its outward normals.
struct Rim {
  double along = 0.0;
  double radius = 0.0;
  double normal_along = 0.0;
  double normal_out = 0.0;
};

/// A solid of revolution about the axis from `foot`.
class Lathe {
 public:
  Lathe(TriangleMesh& mesh, const Point3& foot, const Point3& axis, int sides)
      : mesh_(mesh), foot_(foot), axis_(axis), sides_(sides) {
    // Across the coordinate axis that the solid's is farthest from; the lower one of two.
    Eigen::Index least = 0;
    axis.cwiseAbs().minCoeff(&least);
    u_ = axis.cross(Point3::Unit(least)).normalized();
    v_ = axis.cross(u_);
  }

  /// The surface between each rim and the next.
  void turn(std::span<const Rim> rims) {
    for (std::size_t i = 0; i + 1 < rims.size(); ++i) add_band(rims[i], rims[i + 1]);
  }

 private:
  void add_ring(const Rim& rim) {
    for (int side = 0; side < sides_; ++side) {
      const double angle = 2.0 * std::numbers::pi * side / sides_;
      const Point3 out = std::cos(angle) * u_ + std::sin(angle) * v_;
      mesh_.points.push_back(foot_ + rim.along * axis_ + rim.radius * out);
      mesh_.normals.push_back(rim.normal_along * axis_ + rim.normal_out * out);
    }
  }

  void add_band(const Rim& a, const Rim& b) {
    const auto first = static_cast<std::uint32_t>(mesh_.points.size());
    const auto sides = static_cast<std::uint32_t>(sides_);
    add_ring(a);
    add_ring(b);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t j = (i + 1) % sides;
      if (a.radius > 0.0) mesh_.triangles.push_back({first + i, first + j, first + sides + j});
      if (b.radius > 0.0)
        mesh_.triangles.push_back({first + i, first + sides + j, first + sides + i});
    }
  }

  TriangleMesh& mesh_;
  Point3 foot_, axis_, u_, v_;
  int sides_;
};

}  // namespace

void add_rod(TriangleMesh& mesh, const Point3& from, const Point3& to, double radius, int sides) {
  const double length = (to - from).norm();
  if (!(length > 0.0)) return;
  Lathe lathe(mesh, from, (to - from) / length, sides);
  lathe.turn(std::array<Rim, 2>{{{0.0, 0.0, -1.0, 0.0}, {0.0, radius, -1.0, 0.0}}});
  lathe.turn(std::array<Rim, 2>{{{0.0, radius, 0.0, 1.0}, {length, radius, 0.0, 1.0}}});
  lathe.turn(std::array<Rim, 2>{{{length, radius, 1.0, 0.0}, {length, 0.0, 1.0, 0.0}}});
}

void add_arrow(TriangleMesh& mesh, const Point3& from, const Point3& to, double radius, int sides) {
  const double length = (to - from).norm();
  if (!(length > 0.0)) return;
  const Point3 axis = (to - from) / length;
  const double head = std::min(4.0 * radius, length), wide = head * 0.75;
  if (length > head) add_rod(mesh, from, to - head * axis, radius, sides);
  const double slant = std::hypot(head, wide);
  const double foot = length - head;
  Lathe lathe(mesh, from, axis, sides);
  lathe.turn(std::array<Rim, 2>{{{foot, 0.0, -1.0, 0.0}, {foot, wide, -1.0, 0.0}}});
  lathe.turn(std::array<Rim, 2>{
      {{foot, wide, wide / slant, head / slant}, {length, 0.0, wide / slant, head / slant}}});
}

void add_sphere(TriangleMesh& mesh, const Point3& at, double radius, int sides) {
  const int slices = std::max(2, sides / 2);
  std::vector<Rim> rims;
  for (int i = 0; i <= slices; ++i) {
    const double angle = std::numbers::pi * i / slices;
    const double along = -std::cos(angle), out = i == 0 || i == slices ? 0.0 : std::sin(angle);
    rims.push_back({radius * along, radius * out, along, out});
  }
  Lathe(mesh, at, Point3::UnitZ(), sides).turn(rims);
}

}  // namespace mapproof
