#include "render/scene/baked_light.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace mapproof {
namespace {

constexpr std::size_t kDirections = 64;  // Of the key light, a bit of a word each.
constexpr double kLightRadius_rad = 0.08;
constexpr double kKeyShare = 0.6, kSkyShare = 0.4;  // Of the light on an open floor.
constexpr double kBounce = 0.4;                     // From the pale floor to what faces it.
constexpr double kNear = 0.2;                       // Of the floor's side: what takes sky away.
constexpr double kMargin = 0.12;                    // Of the floor's side, of the shadow around it.
constexpr double kFloorFloat = 1e-4;  // Of the floor's side: from a surface to its rays.
constexpr double kGamma = 2.2;
// Of the radius, from the floor to the axis: what is lower covers most of its shadow.
constexpr double kLying = 3.0;

struct Bounds {
  Point3 low = Point3::Constant(HUGE_VAL), high = Point3::Constant(-HUGE_VAL);
};

Bounds bounds_of(const std::vector<Point3>& points) {
  Bounds all;
  for (const Point3& point : points) {
    all.low = all.low.cwiseMin(point);
    all.high = all.high.cwiseMax(point);
  }
  return all;
}

bool casts_shadow(const Style& style) { return style.lit && style.opacity >= 1.0; }

bool is_level(const Surface& surface) {
  if (surface.style.lit || surface.style.opacity < 1.0 || surface.points.empty()) return false;
  const Bounds all = bounds_of(surface.points);
  return all.low.z() == all.high.z();
}

/// Share of the sky that a pillar of that height takes from a point at that distance of its axis.
double sky_behind_pillar(double distance, double radius, double height) {
  if (distance <= radius) return 0.5;
  const double gap = distance - radius;
  return std::asin(radius / distance) / std::numbers::pi * height * height /
         (height * height + gap * gap);
}

/// As above, for a long wall.
double sky_behind_wall(double distance, double height) {
  if (height <= 0.0) return 0.0;
  return 0.5 * (1.0 - distance / std::sqrt(distance * distance + height * height));
}

}  // namespace

std::optional<BakedLight> BakedLight::of(const Scene& scene, const Shot& view) {
  BakedLight light;
  for (std::size_t i = 0; i < scene.parts.size(); ++i) {
    const auto* surface = std::get_if<Surface>(&scene.parts[i]);
    if (surface == nullptr || !shows(view, i) || !is_level(*surface)) continue;
    const Bounds floor = bounds_of(surface->points);
    const double extent = (floor.high - floor.low).maxCoeff();
    if (extent <= light.extent_) continue;
    light.floor_low_ = floor.low;
    light.floor_high_ = floor.high;
    light.extent_ = extent;
  }
  if (light.extent_ <= 0.0 || scene.lights.empty()) return std::nullopt;
  for (std::size_t i = 0; i < scene.parts.size(); ++i)
    if (shows(view, i)) std::visit([&light](const auto& part) { light.add(part); }, scene.parts[i]);
  light.aim(scene);
  if (light.key_.empty()) return std::nullopt;
  return light;
}

void BakedLight::add(const Rods& rods) {
  if (rods.arrow || !casts_shadow(rods.style)) return;
  for (std::size_t i = 0; i < rods.from.size(); ++i) {
    const Point3 &from = rods.from[i], &to = rods.to[i];
    if (from.z() == floor_z() && to.z() > floor_z() && from.x() == to.x() && from.y() == to.y())
      pillars_.push_back({from.x(), from.y(), rods.radius, to.z()});
  }
}

void BakedLight::add(const Tube& tube) {
  if (!casts_shadow(tube.style)) return;
  for (std::size_t i = 1; i < tube.points.size(); ++i)
    add(Capsule{tube.points[i - 1], tube.points[i], tube.radius});
}

void BakedLight::add(const Spheres& spheres) {
  if (!casts_shadow(spheres.style)) return;
  for (const Point3& at : spheres.at) add(Capsule{at, at, spheres.radius});
}

void BakedLight::add(const Capsule& capsule) {
  const double height = std::min(capsule.from.z(), capsule.to.z()) - floor_z();
  if (height > kLying * capsule.radius) capsules_.push_back(capsule);
}

/// Upright rectangles, each of two triangles as add_rectangle() makes them.
void BakedLight::add(const Surface& surface) {
  if (!casts_shadow(surface.style) || surface.smooth) return;
  for (std::size_t i = 0; i + 3 < surface.points.size(); i += 4) {
    const auto first = surface.points.begin() + static_cast<std::ptrdiff_t>(i);
    const Bounds one = bounds_of(std::vector<Point3>(first, first + 4));
    const Point3 size = one.high - one.low;
    const bool upright = size.z() > 0.0 && std::min(size.x(), size.y()) == 0.0;
    if (upright && one.low.z() == floor_z())
      walls_.push_back({one.low.x(), one.high.x(), one.low.y(), one.high.y(), one.high.z()});
  }
}

/// Points of the strongest light, on a Vogel spiral over its disc.
void BakedLight::aim(const Scene& scene) {
  const Light& key = *std::ranges::max_element(scene.lights, {}, &Light::strength);
  const Point3 towards = key.from.normalized();
  if (towards.z() < 0.1) return;  // Shadows without end.
  axis_ = towards;
  const Point3 across = towards.unitOrthogonal(), along = towards.cross(across);
  constexpr double kTurn = std::numbers::pi * (3.0 - 2.2360679774997896);  // The golden angle.
  for (std::size_t k = 0; k < kDirections; ++k) {
    const double share = (static_cast<double>(k) + 0.5) / kDirections;
    const double radius = std::tan(kLightRadius_rad) * std::sqrt(share);
    const double angle = kTurn * static_cast<double>(k);
    key_.push_back(
        (towards + radius * (std::cos(angle) * across + std::sin(angle) * along)).normalized());
  }
  const double length = std::hypot(towards.x(), towards.y());
  double widest = length > 1e-6 ? 0.0 : std::numbers::pi;  // Light from above comes from all sides.
  if (length > 1e-6) wedge_ = {towards.x() / length, towards.y() / length};
  for (const Point3& one : key_) {
    const double side = wedge_.x * one.y() - wedge_.y * one.x();
    widest = std::max(widest, std::abs(std::atan2(side, wedge_.x * one.x() + wedge_.y * one.y())));
    wedge_.way = std::max(wedge_.way, std::hypot(one.x(), one.y()) / one.z());
  }
  wedge_.sine = std::sin(std::min(widest, std::numbers::pi / 2.0));
  wedge_.cosine = std::cos(std::min(widest, std::numbers::pi / 2.0));
  if (widest > std::numbers::pi / 2.0) wedge_.sine = 2.0;  // All around.
}

bool BakedLight::may_hit(const Pillar& pillar, const Point3& from) const {
  constexpr double kRounding = 1e-9;
  const double x = pillar.x - from.x(), y = pillar.y - from.y();
  const double distance = std::sqrt(x * x + y * y), radius = pillar.radius + kRounding;
  if (distance - radius > (pillar.top - from.z()) * wedge_.way) return false;
  if (wedge_.sine > 1.0) return true;
  const double ahead = x * wedge_.x + y * wedge_.y, aside = std::abs(x * wedge_.y - y * wedge_.x);
  // Nearest to the wedge's tip, or to its edge.
  if (ahead * wedge_.cosine + aside * wedge_.sine < 0.0) return distance <= radius;
  return aside * wedge_.cosine - ahead * wedge_.sine <= radius;
}

bool BakedLight::hits(const Pillar& pillar, const Point3& from, const Point3& towards) {
  const double x = from.x() - pillar.x, y = from.y() - pillar.y;
  const double a = towards.x() * towards.x() + towards.y() * towards.y();
  const double b = x * towards.x() + y * towards.y();
  const double square = b * b - a * (x * x + y * y - pillar.radius * pillar.radius);
  if (square <= 0.0) return false;
  const double root = std::sqrt(square);
  const double enter = (-b - root) / a, leave = (-b + root) / a;
  return leave > 0.0 && std::max(enter, 0.0) < (pillar.top - from.z()) / towards.z();
}

bool BakedLight::hits(const Wall& wall, const Point3& from, const Point3& towards) {
  double enter = 0.0, leave = (wall.top - from.z()) / towards.z();
  const auto clip = [&](double low, double high, double at, double slope) {
    if (slope == 0.0) {
      if (at < low || at > high) leave = -1.0;
      return;
    }
    const double a = (low - at) / slope, b = (high - at) / slope;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  };
  clip(wall.x0, wall.x1, from.x(), towards.x());
  clip(wall.y0, wall.y1, from.y(), towards.y());
  return enter <= leave && leave > 0.0;
}

/// The ray hits if its least distance from the axis is below the radius. The closest points of a
/// ray and a segment have a closed form; the determinant is that of its two equations.
bool BakedLight::hits(const Capsule& capsule, const Point3& from, const Point3& towards) {
  constexpr double kParallel = 1e-12;  // Of the squared length: any point of the axis will do.
  const Point3 axis = capsule.to - capsule.from, offset = from - capsule.from;
  const double length = axis.squaredNorm(), slope = towards.dot(axis);
  const double ahead = towards.dot(offset), aside = axis.dot(offset);
  const double determinant = length - slope * slope;
  double along_axis = determinant > kParallel * length
                          ? std::clamp((aside - slope * ahead) / determinant, 0.0, 1.0)
                          : 0.0;
  double along_ray = slope * along_axis - ahead;
  if (along_ray < 0.0) {
    along_ray = 0.0;
    if (length > 0.0) along_axis = std::clamp(aside / length, 0.0, 1.0);
  }
  const Point3 apart = offset + along_ray * towards - along_axis * axis;
  return apart.squaredNorm() < capsule.radius * capsule.radius;
}

/// Those whose ball around reaches into the cone of the light.
std::vector<BakedLight::Capsule> BakedLight::capsules_near(const Point3& point) const {
  const double spread = std::tan(kLightRadius_rad), slant = 1.0 / std::cos(kLightRadius_rad);
  std::vector<Capsule> found;
  for (const Capsule& capsule : capsules_) {
    const Point3 middle = (capsule.from + capsule.to) / 2.0 - point;
    const double reach = (capsule.to - capsule.from).norm() / 2.0 + capsule.radius;
    const double ahead = middle.dot(axis_);
    const double aside = (middle - ahead * axis_).norm();
    if (ahead > -reach && aside <= slant * reach + spread * std::max(ahead, 0.0))
      found.push_back(capsule);
  }
  return found;
}

std::vector<BakedLight::Pillar> BakedLight::pillars_near(const Point3& point) const {
  const double near = kNear * extent_;
  std::vector<Pillar> found;
  for (const Pillar& pillar : pillars_)
    if (std::abs(pillar.x - point.x()) < near + pillar.radius &&
        std::abs(pillar.y - point.y()) < near + pillar.radius && may_hit(pillar, point))
      found.push_back(pillar);
  return found;
}

double BakedLight::sky_at(const Point3& point) const {
  const double near = kNear * extent_;
  double sky = 1.0;
  for (const Pillar& pillar : pillars_) {
    const double x = pillar.x - point.x(), y = pillar.y - point.y();
    const double square = x * x + y * y;
    if (square >= near * near) continue;
    const double distance = std::sqrt(square);
    if (distance > 1.05 * pillar.radius && pillar.top > point.z())
      sky *= 1.0 - sky_behind_pillar(distance, pillar.radius, pillar.top - point.z());
  }
  for (const Wall& wall : walls_) {
    const double x = std::max({wall.x0 - point.x(), point.x() - wall.x1, 0.0});
    const double y = std::max({wall.y0 - point.y(), point.y() - wall.y1, 0.0});
    const double distance = std::sqrt(x * x + y * y);
    if (distance > kFloorFloat * extent_)
      sky *= 1.0 - sky_behind_wall(distance, wall.top - point.z());
  }
  return sky;
}

double BakedLight::at(const Point3& point, const Point3& normal) const {
  const Point3 from = point + 10.0 * kFloorFloat * extent_ * normal;
  const std::vector<Pillar> near = pillars_near(from);
  const std::vector<Capsule> capsules = capsules_near(from);
  double key = 0.0;
  for (const Point3& towards : key_) {
    const double facing = normal.dot(towards);
    const auto hides = [&](const auto& thing) { return hits(thing, from, towards); };
    if (facing > 0.0 && !std::ranges::any_of(near, hides) && !std::ranges::any_of(walls_, hides) &&
        !std::ranges::any_of(capsules, hides))
      key += facing / towards.z();
  }
  const double upward = 0.55 + 0.45 * normal.z();
  const double lift = 0.025 * extent_;
  const double bounce =
      kBounce * (1.0 - upward) * (0.3 + 0.7 * (1.0 - std::exp(-(point.z() - floor_z()) / lift)));
  return kKeyShare * key / kDirections + kSkyShare * sky_at(point) * upward + bounce;
}

namespace {

/// A square of texels on the floor, and a bit for each direction of the light that is hidden there.
class ShadowTexels {
 public:
  ShadowTexels(const Point3& corner, double side, int size)
      : corner_(corner),
        texel_(side / size),
        size_(size),
        hidden_(static_cast<std::size_t>(size) * size, 0) {}

  double texel() const { return texel_; }

  Point3 position(int i, int j) const {
    return corner_ + Point3((i + 0.5) * texel_, (j + 0.5) * texel_, 0.0);
  }

  /// Sets the bits that `hides(position)` gives, at the texels of a rectangle.
  template <class Hides>
  void hide(double x0, double x1, double y0, double y1, const Hides& hides) {
    for (int j = index_of(y0 - corner_.y()); j <= index_of(y1 - corner_.y()); ++j)
      for (int i = index_of(x0 - corner_.x()); i <= index_of(x1 - corner_.x()); ++i)
        hidden_[static_cast<std::size_t>(j) * size_ + i] |= hides(position(i, j));
  }

  /// The share of the directions that are hidden.
  double dark(int i, int j) const {
    return std::popcount(hidden_[static_cast<std::size_t>(j) * size_ + i]) /
           static_cast<double>(kDirections);
  }

 private:
  int index_of(double offset) const {
    return std::clamp(static_cast<int>(offset / texel_), 0, size_ - 1);
  }

  Point3 corner_;
  double texel_;
  int size_;
  std::vector<std::uint64_t> hidden_;
};

}  // namespace

BakedLight::Shadow BakedLight::shadow(int size) const {
  const double margin = kMargin * extent_;
  Shadow shadow;
  shadow.corner = floor_low_ - Point3(margin, margin, 0.0);
  shadow.side = extent_ + 2.0 * margin;
  shadow.size = size;
  ShadowTexels texels(shadow.corner, shadow.side, size);
  // Only texels within the longest shadow of a thing can be hidden by it.
  const auto cast = [&](const auto& thing, double x0, double x1, double y0, double y1) {
    const Point3& key = key_.front();
    const double length = 1.3 * (thing.top - floor_z()) / key.z();
    const double dx = -key.x() * length, dy = -key.y() * length;
    const double soft = 0.3 * length * key.z() + texels.texel();
    texels.hide(std::min(x0, x0 + dx) - soft, std::max(x1, x1 + dx) + soft,
                std::min(y0, y0 + dy) - soft, std::max(y1, y1 + dy) + soft, [&](const Point3& at) {
                  std::uint64_t bits = 0;
                  if (!may_hit(thing, at)) return bits;
                  for (std::size_t k = 0; k < key_.size(); ++k)
                    if (hits(thing, at, key_[k])) bits |= std::uint64_t{1} << k;
                  return bits;
                });
  };
  for (const Pillar& one : pillars_)
    cast(one, one.x - one.radius, one.x + one.radius, one.y - one.radius, one.y + one.radius);
  for (const Wall& one : walls_) cast(one, one.x0, one.x1, one.y0, one.y1);
  // In one direction the shadow of a capsule is small, and far from those in other directions.
  for (const Capsule& capsule : capsules_)
    for (std::size_t k = 0; k < key_.size(); ++k) {
      const Point3& key = key_[k];
      const Point3 a = capsule.from - (capsule.from.z() - floor_z()) / key.z() * key;
      const Point3 b = capsule.to - (capsule.to.z() - floor_z()) / key.z() * key;
      const double soft = capsule.radius / key.z();
      texels.hide(std::min(a.x(), b.x()) - soft, std::max(a.x(), b.x()) + soft,
                  std::min(a.y(), b.y()) - soft, std::max(a.y(), b.y()) + soft,
                  [&](const Point3& at) {
                    return hits(capsule, at, key) ? std::uint64_t{1} << k : std::uint64_t{0};
                  });
    }
  for (int j = 0; j < size; ++j)
    for (int i = 0; i < size; ++i) {
      const Point3 at = texels.position(i, j);
      const double outside = std::max({floor_low_.x() - at.x(), at.x() - floor_high_.x(),
                                       floor_low_.y() - at.y(), at.y() - floor_high_.y(), 0.0});
      // Around the floor the sky comes back soon: an image ends there.
      const double fade = 1.0 - std::clamp(outside / (0.9 * margin), 0.0, 1.0);
      const double light = kKeyShare * (1.0 - fade * texels.dark(i, j)) +
                           kSkyShare * (1.0 - fade * fade * fade * (1.0 - sky_at(at)));
      const double alpha = 1.0 - std::pow(light, 1.0 / kGamma);
      shadow.alpha.push_back(
          static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(alpha, 0.0, 1.0))));
    }
  return shadow;
}

const std::vector<double>& KeptLight::at(std::size_t part, const TriangleMesh& mesh) {
  const auto [found, is_new] = of_parts_.try_emplace(part);
  if (is_new)
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
      found->second.push_back(light_.at(mesh.points[i], mesh.normals[i]));
  return found->second;
}

const BakedLight::Shadow& KeptLight::shadow() {
  constexpr int kTexels = 512;
  if (!shadow_) shadow_ = light_.shadow(kTexels);
  return *shadow_;
}

namespace {

/// Radius and height of a ring of a turned body, and its normal outward and upward.
struct Ring {
  double radius, height, outward, upward;
};

std::vector<Ring> pillar_rings(double radius, double height) {
  constexpr int kSteps = 8, kEdge = 3;
  const double bevel = std::min(0.25 * radius, 0.5 * height);
  std::vector<Ring> rings;
  for (int i = 0; i <= kSteps; ++i)
    rings.push_back({radius, (height - bevel) * i / kSteps, 1.0, 0.0});
  for (int i = 1; i <= kEdge; ++i) {
    const double angle = std::numbers::pi / 2.0 * i / kEdge;
    const double outward = std::cos(angle), upward = std::sin(angle);
    rings.push_back(
        {radius - bevel + bevel * outward, height - bevel + bevel * upward, outward, upward});
  }
  rings.push_back({0.0, height, 0.0, 1.0});
  return rings;
}

}  // namespace

void add_pillar(TriangleMesh& mesh, const Point3& foot, const Point3& top, double radius,
                int sides) {
  const double height = top.z() - foot.z();
  if (!(height > 0.0)) return;
  const auto base = static_cast<std::uint32_t>(mesh.points.size());
  const auto n = static_cast<std::uint32_t>(sides);
  const std::vector<Ring> rings = pillar_rings(radius, height);
  for (const Ring& ring : rings)
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      const Point3 out(std::cos(angle), std::sin(angle), 0.0);
      mesh.points.push_back(foot + ring.radius * out + ring.height * Point3::UnitZ());
      mesh.normals.push_back(ring.outward * out + ring.upward * Point3::UnitZ());
    }
  for (std::uint32_t j = 1; j < rings.size(); ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = base + (j - 1) * n + i, b = base + (j - 1) * n + (i + 1) % n;
      mesh.triangles.push_back({a, b, b + n});
      mesh.triangles.push_back({a, b + n, a + n});
    }
}

TriangleMesh fine_mesh(const Surface& surface, double longest) {
  std::vector<std::array<Point3, 3>> left;
  for (const auto& [a, b, c] : surface.triangles)
    left.push_back({surface.points[a], surface.points[b], surface.points[c]});
  TriangleMesh mesh;
  while (!left.empty()) {
    const std::array<Point3, 3> t = left.back();
    left.pop_back();
    std::size_t edge = 0;
    const auto length = [&](std::size_t i) { return (t[(i + 1) % 3] - t[i]).norm(); };
    for (std::size_t i = 1; i < 3; ++i)
      if (length(i) > length(edge)) edge = i;
    if (length(edge) > longest) {
      const Point3 &from = t[edge], &to = t[(edge + 1) % 3], &other = t[(edge + 2) % 3];
      const Point3 middle = (from + to) / 2.0;
      left.push_back({from, middle, other});
      left.push_back({middle, to, other});
      continue;
    }
    const Point3 across = (t[1] - t[0]).cross(t[2] - t[0]);
    if (across.norm() == 0.0) continue;
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const Point3& corner : t) {
      mesh.points.push_back(corner);
      mesh.normals.push_back(across.normalized());
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace mapproof
