#include "render/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr double kGreatestCoordinate =
    1e9;  // Single precision, which a graphics library takes, bears it.
constexpr double kLeastAngle = 1e-6;

bool is_place(const Point3& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= kGreatestCoordinate;
}

std::string places(const std::vector<Point3>& points, const char* name) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!is_place(points[i])) return fmt::format("{}/{}: not finite, or beyond 1e9", name, i);
  return {};
}

bool is_direction(const Point3& p) { return is_place(p) && p.norm() > 1e-12; }

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
  if (std::string what = places(surface.points, "points"); !what.empty()) return what;
  for (std::size_t i = 0; i < surface.triangles.size(); ++i)
    for (const std::uint32_t corner : surface.triangles[i])
      if (corner >= surface.points.size())
        return fmt::format("triangles/{}: there is no point {}", i, corner);
  return style_problem(surface, surface.points.size());
}

std::string part_problem(const Tube& tube) {
  if (std::string what = places(tube.points, "points"); !what.empty()) return what;
  if (!is_length(tube.radius)) return "radius: not in (0, 1e9]";
  return style_problem(tube, tube.points.size());
}

std::string part_problem(const Rods& rods) {
  if (rods.from.size() != rods.to.size()) return "to: not as many as from";
  if (std::string what = places(rods.from, "from"); !what.empty()) return what;
  if (std::string what = places(rods.to, "to"); !what.empty()) return what;
  if (!is_length(rods.radius)) return "radius: not in (0, 1e9]";
  return style_problem(rods, rods.from.size());
}

std::string part_problem(const Spheres& spheres) {
  if (std::string what = places(spheres.at, "at"); !what.empty()) return what;
  if (!is_length(spheres.radius)) return "radius: not in (0, 1e9]";
  return style_problem(spheres, spheres.at.size());
}

std::string part_problem(const Field& field) {
  if (std::string what = places(field.points, "points"); !what.empty()) return what;
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
  if (!is_place(camera.eye) || !is_place(camera.target)) return "eye, target: not finite";
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
  if (!is_place(rule.from) || !is_place(rule.to)) return "from, to: not finite";
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
    if (std::string what = places(view.labels[i].at, "at"); !what.empty())
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

}  // namespace mapproof
