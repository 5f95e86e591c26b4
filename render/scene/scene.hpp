#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "render/plot/figure.hpp"

namespace mapproof {

/// A point in space: x and y along the floor, z upward, metres where the scene is of a room.
using Point3 = Eigen::Vector3d;

/// How a surface looks.
struct Style {
  ThemeColour colour = ThemeColour::kMuted;
  double share = 1.0;    ///< Of the colour, the rest being background, in [0, 1].
  double opacity = 1.0;  ///< In (0, 1]; parts that are not opaque are drawn in their order.
  bool lit = true;       ///< Shaded by the lights; else in one flat colour.

  bool operator==(const Style&) const = default;
};

/// Values that replace a style's colour, in viridis; none: the colour.
struct Tones {
  std::vector<double> values = {};  ///< One a point, rod or sphere; NaN takes the colour.
  Range limits = {};                ///< The values at the ends of the ramp; beyond: the ends.
  /// Of a colour bar beside each view of the part, with its unit; empty: the legend has the ramp.
  std::string bar_label = {};

  bool operator==(const Tones&) const = default;
};

/// Triangles, seen from both sides.
struct Surface {
  std::string label = {};  ///< In the legend; empty: not there.
  std::vector<Point3> points = {};
  std::vector<std::array<std::uint32_t, 3>> triangles = {};
  bool smooth = false;  ///< Shaded as if it were round.
  Style style = {};
  Tones tones = {};  ///< One a point.

  bool operator==(const Surface&) const = default;
};

/// A round line through points.
struct Tube {
  std::string label = {};
  std::vector<Point3> points = {};  ///< Neighbours that fall on each other count once.
  double radius = 0.01;
  Style style = {};
  Tones tones = {};  ///< One a point.

  bool operator==(const Tube&) const = default;
};

/// Straight round bars with flat ends, or arrows; those without a length are not drawn.
struct Rods {
  std::string label = {};
  std::vector<Point3> from = {};
  std::vector<Point3> to = {};
  double radius = 0.01;
  bool arrow = false;  ///< With a head at `to`.
  Style style = {};
  Tones tones = {};  ///< One a rod.

  bool operator==(const Rods&) const = default;
};

struct Spheres {
  std::string label = {};
  std::vector<Point3> at = {};
  double radius = 0.01;
  Style style = {};
  Tones tones = {};  ///< One a sphere.

  bool operator==(const Spheres&) const = default;
};

/// Values at scattered points, interpolated linearly over the triangles of their plan
/// [delaunay1934], with lines of equal value.
struct Field {
  std::string label = {};
  std::vector<Point3> points = {};  ///< At least three, no two of them above each other.
  Style style = {};
  Tones tones = {};                 ///< One a point, none of them NaN.
  std::vector<double> levels = {};  ///< Of the contours, ascending.
  double contour_radius = 0.004;

  bool operator==(const Field&) const = default;
};

using Part = std::variant<Surface, Tube, Rods, Spheres, Field>;

/// Where the scene is seen from. The image shows `height` at the target's distance if parallel,
/// else `angle_rad`, from its lower to its upper edge, and `aspect` times that across.
struct Camera {
  Point3 eye = {0.0, -1.0, 0.0};
  Point3 target = Point3::Zero();
  Point3 up = Point3::UnitZ();
  bool parallel = false;
  double height = 1.0;     ///< > 0; of a parallel camera.
  double angle_rad = 0.5;  ///< In (0, pi); of a perspective one.
  double aspect = 1.6;

  bool operator==(const Camera&) const = default;
};

/// Light from infinitely far away.
struct Light {
  Point3 from = Point3::UnitZ();  ///< Its direction as seen from the scene; any length above 0.
  double strength = 1.0;          ///< In [0, 10].

  bool operator==(const Light&) const = default;
};

/// Texts beside points, placed in the image where they cover nothing; one that fits nowhere is
/// left out.
struct SceneLabels {
  std::vector<Point3> at = {};
  std::vector<std::string> text = {};
  ThemeColour colour = ThemeColour::kText;

  bool operator==(const SceneLabels&) const = default;
};

/// An axis through the scene, with ticks: values from `range.low` at `from` to `range.high` at
/// `to`.
struct Rule {
  Point3 from = Point3::Zero();
  Point3 to = Point3::UnitX();
  Range range = {};
  std::string label = {};          ///< With its unit.
  Point3 away = -Point3::UnitY();  ///< From the axis towards its labels; any length above 0.

  bool operator==(const Rule&) const = default;
};

/// One image of the scene.
struct Shot {
  std::string title = {};
  Camera camera = {};
  std::vector<std::size_t> parts = {};  ///< Those that are shown, ascending; empty: all.
  std::vector<SceneLabels> labels = {};
  std::vector<Rule> rules = {};

  bool operator==(const Shot&) const = default;
};

/// A three-dimensional scene as a value: the same for every size and theme, with or without VTK.
struct Scene {
  std::string id = {};  ///< As a figure's; never taken from data.
  std::string title = {};
  std::string caption = {};
  std::string alt = {};  ///< What the scene shows, in words with numbers.
  std::vector<std::string> record_ids = {};
  bool varies = false;  ///< Shows what differs from run to run.
  std::vector<Note> notes = {};
  std::vector<Part> parts = {};
  std::vector<Light> lights = {};
  std::vector<Shot> views = {};  ///< At least one; their cameras have one aspect.
  std::size_t columns = 0;       ///< As a figure's.

  bool operator==(const Scene&) const = default;
};

/// What keeps the scene from being drawn, as one line that names the location; empty if nothing
/// does: ids, sizes that do not match, positions that are not finite, a camera that looks along
/// `up`.
std::string problem(const Scene& scene);

/// @throws InvalidInput with `problem(scene)` if there is one.
void require_valid(const Scene& scene);

/// Whether a view shows a part.
bool shows(const Shot& view, std::size_t part);

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
