#include "render/scene/baked_light.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "render/scene/room.hpp"

namespace mapproof::test {
namespace {

constexpr double kSide = 10.0, kPillar = 1.0;

/// A floor with one pillar in its middle, lit from the left (from -x).
Scene one_pillar() {
  Scene scene;
  scene.views.resize(1);
  scene.lights = {{{-1.0, 0.0, 1.0}, 1.0}};
  scene.parts = {floor_of(kSide), Rods{.from = {{5.0, 5.0, 0.0}},
                                       .to = {{5.0, 5.0, kPillar}},
                                       .radius = 0.2}};
  return scene;
}

double light_at(const Scene& scene, double x, double y) {
  return BakedLight::of(scene, scene.views[0])->at({x, y, 0.0}, Point3::UnitZ());
}

TEST(BakedLight, IsOneOnAnOpenFloor) {
  EXPECT_NEAR(light_at(one_pillar(), 1.0, 1.0), 1.0, 1e-12);
}

TEST(BakedLight, LosesTheKeyInAShadowAndSomeSkyBesideAPillar) {
  const Scene scene = one_pillar();
  EXPECT_LT(light_at(scene, 5.6, 5.0), 0.42);  // As long as the pillar is high, away from the light.
  EXPECT_GT(light_at(scene, 4.4, 5.0), 0.85);
  EXPECT_LT(light_at(scene, 4.4, 5.0), 0.99);
  EXPECT_GT(light_at(scene, 6.6, 5.0), 0.98);  // Beyond the shadow's end.
}

TEST(BakedLight, HasSoftEdgesOfShadows) {
  const Scene scene = one_pillar();
  const double inside = light_at(scene, 5.9, 5.0), edge = light_at(scene, 5.9, 5.2),
               outside = light_at(scene, 5.9, 5.5);
  EXPECT_GT(edge, inside + 0.1);
  EXPECT_LT(edge, outside - 0.1);
}

TEST(BakedLight, NeedsAFloor) {
  Scene scene = one_pillar();
  scene.parts.erase(scene.parts.begin());
  EXPECT_FALSE(BakedLight::of(scene, scene.views[0]));
  scene = one_pillar();
  scene.views[0].parts = {1};
  EXPECT_FALSE(BakedLight::of(scene, scene.views[0]));
}

TEST(BakedLight, IsTakenByWallsAtTheirFeet) {
  Scene scene = one_pillar();
  const double open = light_at(scene, 9.9, 5.0);
  scene.parts.emplace_back(walls_of(kSide));
  EXPECT_LT(light_at(scene, 9.9, 5.0), open - 0.1);
  EXPECT_LT(light_at(scene, 0.1, 5.0), 0.5);  // The wall towards the light casts a shadow.
}

TEST(BakedLight, CastsTheShadowThatPointsOfTheFloorHaveAndFadesOut) {
  const Scene scene = one_pillar();
  const BakedLight light = *BakedLight::of(scene, scene.views[0]);
  const BakedLight::Shadow shadow = light.shadow(100);
  ASSERT_EQ(shadow.alpha.size(), 10000U);
  const double texel = shadow.side / shadow.size;
  for (int j = 0; j < shadow.size; ++j)
    for (int i = 0; i < shadow.size; ++i) {
      const Point3 at = shadow.corner + Point3((i + 0.5) * texel, (j + 0.5) * texel, 0.0);
      const int alpha = shadow.alpha[static_cast<std::size_t>(j) * 100 + i];
      if (at.x() > 0.0 && at.x() < kSide && at.y() > 0.0 && at.y() < kSide) {
        const double expected = 1.0 - std::pow(light.at(at, Point3::UnitZ()), 1.0 / 2.2);
        const bool under_pillar = std::hypot(at.x() - 5.0, at.y() - 5.0) < 0.25;
        if (!under_pillar) {
          EXPECT_NEAR(alpha / 255.0, expected, 0.03) << at.transpose();
        }
      }
      if (i == 0 || j == 0 || i == 99 || j == 99) {
        EXPECT_EQ(alpha, 0);
      }
    }
  EXPECT_EQ(light.shadow(100).alpha, shadow.alpha);
}

/// A floor at a height that is not 0, lit from the left, and a part above it.
Scene above_floor(const Part& part) {
  Scene scene = one_pillar();
  Surface floor = floor_of(kSide);
  for (Point3& point : floor.points) point.z() = -2.0;
  scene.parts = {floor, part};
  return scene;
}

constexpr double kSkyAlone = 0.4;  // In a full shadow.

/// The light at a point of that floor: 1 in the open, that of the sky in a full shadow.
double light_below(const Scene& scene, double x, double y) {
  return BakedLight::of(scene, scene.views[0])->at({x, y, -2.0}, Point3::UnitZ());
}

TEST(BakedLight, IsThatOfTheSkyWhereABallIsBeforeTheKeyLight) {
  // The ball is 3 above the floor and the light comes at 45 degrees, so the shadow is 3 to the
  // right.
  const Scene scene = above_floor(Spheres{.at = {{3.0, 5.0, 1.0}}, .radius = 0.5});
  EXPECT_NEAR(light_below(scene, 6.0, 5.0), kSkyAlone, 1e-12);
  EXPECT_NEAR(light_below(scene, 6.0, 6.5), 1.0, 1e-12);
  EXPECT_NEAR(light_below(scene, 3.0, 5.0), 1.0, 1e-12);
  const double edge = light_below(scene, 6.0, 5.5);
  EXPECT_GT(edge, kSkyAlone + 0.05);
  EXPECT_LT(edge, 0.95);
}

TEST(BakedLight, IsThatOfTheSkyBelowATubeAboveTheFloor) {
  const Scene scene = above_floor(
      Tube{.points = {{2.0, 3.0, 0.0}, {2.0, 5.0, 0.0}, {2.0, 7.0, 0.0}}, .radius = 0.3});
  EXPECT_NEAR(light_below(scene, 4.0, 5.0), kSkyAlone, 1e-12);
  EXPECT_NEAR(light_below(scene, 4.0, 8.0), 1.0, 1e-12);
}

TEST(BakedLight, IsWholeBesideThePieceOfATubeThatLiesOnTheFloor) {
  const Scene scene = above_floor(
      Tube{.points = {{2.0, 3.0, -1.7}, {2.0, 5.0, -1.7}, {2.0, 7.0, 0.0}, {2.0, 9.0, 0.0}},
           .radius = 0.3});
  EXPECT_NEAR(light_below(scene, 2.6, 4.0), 1.0, 1e-12);
  EXPECT_NEAR(light_below(scene, 4.0, 8.5), kSkyAlone, 1e-12);
}

TEST(BakedLight, HasAShadowImageThatAgreesWithTheLightAtItsTexels) {
  const Scene scene = above_floor(
      Tube{.points = {{2.0, 3.0, 0.0}, {3.0, 6.0, 1.5}, {4.0, 8.0, -1.0}}, .radius = 0.2});
  const BakedLight light = *BakedLight::of(scene, scene.views[0]);
  const BakedLight::Shadow shadow = light.shadow(100);
  const double texel = shadow.side / shadow.size;
  int hidden = 0;
  for (int j = 0; j < shadow.size; ++j)
    for (int i = 0; i < shadow.size; ++i) {
      const Point3 at = shadow.corner + Point3((i + 0.5) * texel, (j + 0.5) * texel, 0.0);
      if (at.x() < 0.0 || at.x() > kSide || at.y() < 0.0 || at.y() > kSide) continue;
      const int alpha = shadow.alpha[static_cast<std::size_t>(j) * 100 + i];
      const double expected = 1.0 - std::pow(light.at(at, Point3::UnitZ()), 1.0 / 2.2);
      EXPECT_NEAR(alpha / 255.0, expected, 0.05) << at.transpose();
      hidden += light.at(at, Point3::UnitZ()) < 0.5 ? 1 : 0;
    }
  EXPECT_GT(hidden, 20);
}

TEST(AddPillar, IsClosedWithNormalsOutward) {
  TriangleMesh mesh;
  add_pillar(mesh, {1.0, 2.0, 0.0}, {1.0, 2.0, 3.0}, 0.5, 24);
  ASSERT_EQ(mesh.points.size(), mesh.normals.size());
  double highest = 0.0;
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    EXPECT_NEAR(mesh.normals[i].norm(), 1.0, 1e-12);
    EXPECT_LE((mesh.points[i] - Point3(1.0, 2.0, mesh.points[i].z())).norm(), 0.5 + 1e-12);
    highest = std::max(highest, mesh.points[i].z());
  }
  EXPECT_EQ(highest, 3.0);
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point3 across =
        (mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a]);
    EXPECT_GE(across.dot(mesh.normals[a] + mesh.normals[b] + mesh.normals[c]), -1e-12);
  }
}

TEST(FineMesh, KeepsTheAreaAndHasNoLongEdge) {
  const Surface walls = walls_of(kSide);
  const TriangleMesh mesh = fine_mesh(walls, 0.5);
  double area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Point3 ab = mesh.points[b] - mesh.points[a], ac = mesh.points[c] - mesh.points[a];
    area += ab.cross(ac).norm() / 2.0;
    EXPECT_LE(std::max({ab.norm(), ac.norm(), (ac - ab).norm()}), 0.5 + 1e-12);
  }
  const double height = walls.points[2].z();
  EXPECT_NEAR(area, 4.0 * kSide * height, 1e-9);
}

}  // namespace
}  // namespace mapproof::test
