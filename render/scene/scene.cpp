#include "render/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// A piece of the outline that rotates about the axis, and its outward normals.
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

constexpr double kGreatestCoordinate =
    1e9;  // Single precision, which a graphics library takes, bears it.
constexpr double kLeastAngle = 1e-6;

bool is_position(const Point3& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kGreatestCoordinate;
}

std::string positions(const std::vector<Point3>& points, const char* name) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_position(points[i])) return fmt::format("{}/{}: not finite, or beyond 1e9", name, i);
  return {};
}

/// Whether it can be normalised, however small the scene is: its square keeps its digits.
bool is_direction(const Point3& p) {
  return is_position(p) && p.squaredNorm() >= std::numeric_limits<double>::min();
}

bool is_range(const Range& range) {
  return std::isfinite(range.low) && std::isfinite(range.high) && range.low < range.high;
}

bool is_length(double length) { return length > 0.0 && length <= kGreatestCoordinate; }

std::string problem_of(const Style& style) {
  if (!(style.share >= 0.0 && style.share <= 1.0)) return "style/share: not in [0, 1]";
  if (!(style.opacity > 0.0 && style.opacity <= 1.0)) return "style/opacity: not in (0, 1]";
  return {};
}

std::string problem_of(const Tones& tones, std::size_t count) {
  if (tones.values.empty()) return {};
  if (tones.values.size() != count) return "tones/values: not as many as what they colour";
  if (!is_range(tones.limits)) return "tones/limits: not finite and ascending";
  for (std::size_t i = 0; i < tones.values.size(); ++i)
    if (std::isinf(tones.values[i])) return fmt::format("tones/values/{}: infinite", i);
  return {};
}

/// What all parts have in common.
template <typename Any>
std::string style_problem(const Any& part, std::size_t count) {
  if (std::string what = problem_of(part.style); !what.empty()) return what;
  return problem_of(part.tones, count);
}

std::string part_problem(const Surface& surface) {
  if (std::string what = positions(surface.points, "points"); !what.empty()) return what;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (const std::uint32_t corner : surface.triangles[i])
      if (corner >= surface.points.size())
        return fmt::format("triangles/{}: there is no point {}", i, corner);
  return style_problem(surface, surface.points.size());
}

std::string part_problem(const Tube& tube) {
  if (std::string what = positions(tube.points, "points"); !what.empty()) return what;
  if (!is_length(tube.radius)) return "radius: not in (0, 1e9]";
  return style_problem(tube, tube.points.size());
}

std::string part_problem(const Rods& rods) {
  if (rods.from.size() != rods.to.size()) return "to: not as many as from";
  if (std::string what = positions(rods.from, "from"); !what.empty()) return what;
  if (std::string what = positions(rods.to, "to"); !what.empty()) return what;
  if (!is_length(rods.radius)) return "radius: not in (0, 1e9]";
  return style_problem(rods, rods.from.size());
}

std::string part_problem(const Spheres& spheres) {
  if (std::string what = positions(spheres.at, "at"); !what.empty()) return what;
  if (!is_length(spheres.radius)) return "radius: not in (0, 1e9]";
  return style_problem(spheres, spheres.at.size());
}

std::string part_problem(const Field& field) {
  if (std::string what = positions(field.points, "points"); !what.empty()) return what;
  if (field.points.size() < 3) return "points: fewer than three";
  std::vector<std::pair<double, double>> plan;
  for (const Point3& p : field.points) plan.emplace_back(p.x(), p.y());
  std::ranges::sort(plan);
  if (std::ranges::adjacent_find(plan) != plan.end()) return "points: two above each other";
  if (field.tones.values.empty()) return "tones/values: there are none";
  for (std::size_t i = 0; i < field.tones.values.size(); ++i)
    if (std::isnan(field.tones.values[i])) return fmt::format("tones/values/{}: missing", i);
  for (const double level : field.levels)
    if (!std::isfinite(level)) return "levels: not finite";
  if (!std::ranges::is_sorted(field.levels, std::less_equal<>())) return "levels: not ascending";
  if (!is_length(field.contour_radius)) return "contour_radius: not in (0, 1e9]";
  return style_problem(field, field.points.size());
}

std::string problem_of(const Camera& camera) {
  if (!is_position(camera.eye) || !is_position(camera.target)) return "eye, target: not finite";
  const Point3 forward = camera.target - camera.eye;
  if (!is_direction(forward)) return "eye: at the target";
  if (!is_direction(camera.up)) return "up: no direction";
  if (forward.normalized().cross(camera.up.normalized()).norm() < kLeastAngle)
    return "up: along the line of sight";
  if (!is_length(camera.height)) return "height: not in (0, 1e9]";
  if (!(camera.angle_rad > 0.0 && camera.angle_rad < std::numbers::pi))
    return "angle_rad: not in (0, pi)";
  if (!(camera.aspect >= 0.2 && camera.aspect <= 5.0)) return "aspect: not in [0.2, 5]";
  return {};
}

std::string rule_problem(const Rule& rule) {
  if (!is_position(rule.from) || !is_position(rule.to)) return "from, to: not finite";
  if (!is_direction(rule.to - rule.from)) return "to: at from";
  if (!is_direction(rule.away)) return "away: no direction";
  return is_range(rule.range) ? "" : "range: not finite and ascending";
}

std::string view_problem(const Shot& view, std::size_t parts) {
  if (std::string what = problem_of(view.camera); !what.empty()) return "camera/" + what;
  if (!std::ranges::is_sorted(view.parts, std::less_equal<>())) return "parts: not ascending";
  if (!view.parts.empty() && view.parts.back() >= parts) return "parts: there is no such part";
  for (std::size_t i = 0; i < view.labels.size(); ++i) {
    if (view.labels[i].at.size() != view.labels[i].text.size())
      return fmt::format("labels/{}/text: not as many as at", i);
    if (std::string what = positions(view.labels[i].at, "at"); !what.empty())
      return fmt::format("labels/{}/{}", i, what);
  }
  for (std::size_t i = 0; i < view.rules.size(); ++i)
    if (std::string what = rule_problem(view.rules[i]); !what.empty())
      return fmt::format("rules/{}/{}", i, what);
  return {};
}

std::string lights_problem(const std::vector<Light>& lights) {
  constexpr std::size_t kMostLights = 8;
  if (lights.size() > kMostLights) return "lights: more than 8";
  for (std::size_t i = 0; i < lights.size(); ++i) {
    if (!is_direction(lights[i].from)) return fmt::format("lights/{}/from: no direction", i);
    if (!(lights[i].strength >= 0.0 && lights[i].strength <= 10.0))
      return fmt::format("lights/{}/strength: not in [0, 10]", i);
  }
  return {};
}

}  // namespace

bool shows(const Shot& view, std::size_t part) {
  return view.parts.empty() || std::ranges::binary_search(view.parts, part);
}

std::string problem(const Scene& scene) {
  if (!is_figure_id(scene.id))
    return "id: '" + printable(scene.id) + "' is not [a-z][a-z0-9-]* of at most 120 characters";
  for (std::size_t i = 0; i < scene.parts.size(); ++i) {
    const auto inspect = [](const auto& part) { return part_problem(part); };
    if (std::string what = std::visit(inspect, scene.parts[i]); !what.empty())
      return fmt::format("parts/{}/{}", i, what);
  }
  if (std::string what = lights_problem(scene.lights); !what.empty()) return what;
  if (scene.views.empty()) return "views: there is none";
  for (std::size_t i = 0; i < scene.views.size(); ++i) {
    if (std::string what = view_problem(scene.views[i], scene.parts.size()); !what.empty())
      return fmt::format("views/{}/{}", i, what);
    if (scene.views[i].camera.aspect != scene.views[0].camera.aspect)
      return fmt::format("views/{}/camera/aspect: not that of the first view", i);
  }
  return {};
}

void require_valid(const Scene& scene) {
  if (const std::string what = problem(scene); !what.empty())
    throw InvalidInput("scene " + printable(scene.id) + ": " + what);
}

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
