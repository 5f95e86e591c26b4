#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "render/scene/scene.hpp"

namespace mapproof {

/// The light in a scene that stands on a floor, computed without a graphics library: a key light
/// with soft shadows, and a sky that what stands around takes away (ambient occlusion).
///
/// Shadows are exact for upright rods, upright rectangles, balls and tubes, seen from a disc of
/// light. A ball or a piece of a tube that lies on the floor hides its own shadow and casts none.
/// The sky is a product of closed forms of what stands on the floor, which is an approximation.
/// Deterministic.
class BakedLight {
 public:
  /// The light of the parts that the view shows; empty unless they have a floor: the widest level
  /// unlit surface.
  static std::optional<BakedLight> of(const Scene& scene, const Shot& view);

  /// The light at a point of a surface with that normal, in linear light; 1 on an open floor.
  /// @note O(pillars + capsules), and O(directions of the light) of those near the point.
  double at(const Point3& point, const Point3& normal) const;

  /// The shadow on the floor and around it.
  struct Shadow {
    Point3 corner;                    ///< The least x and y of the square.
    double side = 0.0;                ///< Of the square.
    int size = 0;                     ///< Texels along a side.
    std::vector<std::uint8_t> alpha;  ///< Row by row, that of the corner first; 0 is an open floor.
  };
  /// @param size  Texels along a side, > 0.
  Shadow shadow(int size) const;

  double floor_z() const { return floor_low_.z(); }

  /// The longer side of the floor.
  double extent() const { return extent_; }

 private:
  struct Pillar {
    double x = 0.0, y = 0.0, radius = 0.0, top = 0.0;
  };
  struct Wall {
    double x0 = 0.0, x1 = 0.0, y0 = 0.0, y1 = 0.0, top = 0.0;
  };

  /// A rod with round ends: all points within the radius of the segment. A ball if the ends are
  /// one.
  struct Capsule {
    Point3 from, to;
    double radius = 0.0;
  };

  void add(const Rods& rods);
  void add(const Surface& surface);
  void add(const Tube& tube);
  void add(const Spheres& spheres);
  void add(const Field&) {}  ///< Casts no shadow.
  void add(const Capsule& capsule);
  void aim(const Scene& scene);
  /// The pillars that may hide the light from a point.
  std::vector<Pillar> pillars_near(const Point3& point) const;
  /// The capsules that may hide the light from a point.
  std::vector<Capsule> capsules_near(const Point3& point) const;
  /// False if no direction of the key light can hit the pillar: most pairs of a point and a pillar,
  /// for which no direction has to be tried.
  bool may_hit(const Pillar& pillar, const Point3& from) const;
  static bool may_hit(const Wall&, const Point3&) { return true; }
  static bool hits(const Pillar& pillar, const Point3& from, const Point3& towards);
  static bool hits(const Wall& wall, const Point3& from, const Point3& towards);
  static bool hits(const Capsule& capsule, const Point3& from, const Point3& towards);
  double sky_at(const Point3& point) const;

  std::vector<Pillar> pillars_;
  std::vector<Wall> walls_;
  std::vector<Capsule> capsules_;
  std::vector<Point3> key_;        ///< Directions towards points of the light.
  Point3 axis_ = Point3::UnitZ();  ///< Direction towards the middle of the light.
  /// The wedge of these directions in the plan: its middle, of length 1, and half its angle; and
  /// the longest way in the plan of a unit of height.
  struct Wedge {
    double x = 1.0, y = 0.0, sine = 0.0, cosine = 1.0, way = 0.0;
  };
  Wedge wedge_;
  Point3 floor_low_ = Point3::Zero(), floor_high_ = Point3::Zero();
  double extent_ = 0.0;
};

/// The light of one view, each part of it computed once: a view is drawn in the colours of several
/// themes.
class KeptLight {
 public:
  explicit KeptLight(BakedLight light) : light_(std::move(light)) {}

  /// The light at each point of a mesh.
  /// @param part  Whose mesh it is; the same mesh in every call.
  const std::vector<double>& at(std::size_t part, const TriangleMesh& mesh);

  /// The shadow on the floor.
  const BakedLight::Shadow& shadow();

  double extent() const { return light_.extent(); }

 private:
  BakedLight light_;
  std::map<std::size_t, std::vector<double>> of_parts_;
  std::optional<BakedLight::Shadow> shadow_;
};

/// What a rod that stands upright looks like: its side in rings, so that light can change along it,
/// and a rounded upper edge.
void add_pillar(TriangleMesh& mesh, const Point3& foot, const Point3& top, double radius,
                int sides);

/// The surface's triangles with normals of their own, cut until no edge is longer than `longest`.
TriangleMesh fine_mesh(const Surface& surface, double longest);

}  // namespace mapproof
