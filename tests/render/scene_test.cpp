#include "render/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/plot/layout.hpp"
#include "render/scene/projection.hpp"
#include "render/scene/room.hpp"
#include "render/scene/scene_figure.hpp"
#include "render/scene/scene_json.hpp"
#include "render/scene/scene_request.hpp"
#include "tests/support/images/figure_checks.hpp"
#include "tests/support/samples/sample_scenes.hpp"

namespace mapproof::test {
namespace {

TEST(Scene, ComesBackFromJsonAsItWas) {
  for (const Scene& scene : sample_scenes()) {
    const std::string json = scene_to_json(scene);
    const Scene again = scene_from_json(json, "scene");
    EXPECT_EQ(scene_to_json(again), json) << scene.id;  // NaN is unequal to itself.
    EXPECT_EQ(scene_to_json(scene_from_json(scene_to_line(scene), "line")), json);
    EXPECT_EQ(again.views, scene.views);
    EXPECT_EQ(problem(again), "");
  }
}

TEST(Scene, LosesNothingThatIsNotAsItUsuallyIs) {
  Scene scene = small_scene();
  scene.varies = true;
  scene.columns = 2;
  scene.notes = {{"a note", ThemeColour::kWarning}};
  Surface& sheet = std::get<Surface>(scene.parts[5]);
  sheet.smooth = true;
  sheet.tones = {{0.5, 1.0, 1.5, 2.0}, {0.25, 3.0}};
  sheet.style.lit = false;
  sheet.style.share = 0.25;
  Tube& tube = std::get<Tube>(scene.parts[1]);
  tube.tones.values[1] = 1.0;  // NaN is unequal to itself.
  Shot& view = scene.views[0];
  view.title = "a view";
  view.parts = {0, 2, 5};
  view.camera.parallel = true;
  view.camera.height = 3.5;
  view.labels[0].colour = ThemeColour::kWarning;
  view.rules[0].away = {0.5, -0.5, 0.25};
  scene.lights[0].strength = 0.625;
  EXPECT_EQ(scene_from_json(scene_to_json(scene), "scene"), scene);
}

TEST(Scene, SaysWhichPartCannotBeDrawn) {
  const auto refused = [](auto change) {
    Scene scene = small_scene();
    change(scene);
    EXPECT_THROW(require_valid(scene), InvalidInput);
    return problem(scene);
  };
  EXPECT_EQ(refused([](Scene& s) { s.id = "../x"; }).substr(0, 3), "id:");
  EXPECT_EQ(refused([](Scene& s) { s.views.clear(); }), "views: there is none");
  EXPECT_EQ(refused([](Scene& s) { std::get<Tube>(s.parts[1]).radius = 0.0; }),
            "parts/1/radius: not in (0, 1e9]");
  EXPECT_EQ(refused([](Scene& s) { std::get<Rods>(s.parts[2]).to[0].x() = NAN; }),
            "parts/2/to/0: not finite, or beyond 1e9");
  EXPECT_EQ(refused([](Scene& s) { std::get<Field>(s.parts[0]).points[1].setZero(); }),
            "parts/0/points: two above each other");
  EXPECT_EQ(refused([](Scene& s) {
              std::get<Surface>(s.parts[5]).triangles[0] = {0, 1, 99};
            }),
            "parts/5/triangles/0: there is no point 99");
  EXPECT_EQ(refused([](Scene& s) {
              s.views[0].camera.up = s.views[0].camera.target - s.views[0].camera.eye;
            }),
            "views/0/camera/up: along the line of sight");
  EXPECT_EQ(refused([](Scene& s) { s.views[0].rules[0].to = s.views[0].rules[0].from; }),
            "views/0/rules/0/to: at from");
  EXPECT_EQ(refused([](Scene& s) { s.views[0].parts = {9}; }),
            "views/0/parts: there is no such part");
}

TEST(Scene, JsonWithASceneThatCannotBeDrawnIsRefused) {
  Scene scene = small_scene();
  std::get<Spheres>(scene.parts[4]).radius = -1.0;
  EXPECT_THROW(scene_from_json(scene_to_json(scene), "s.json"), IoError);
  EXPECT_THROW(scene_from_json("{}", "s.json"), IoError);
}

TEST(SceneRequest, ComesBackFromItsLine) {
  const SceneRequest request = scene_request(0, 640, 480, 4, report_theme());
  EXPECT_EQ(request_from_line(request_to_line(request), "request"), request);
  const SceneReply reply{"", 3, 4, "VTK"};
  EXPECT_EQ(reply_from_line(reply_to_line(reply), "reply"), reply);
  SceneRequest large = request;
  large.width = 100'000;
  EXPECT_THROW(request_from_line(request_to_line(large), "request"), IoError);
}

TEST(Projection, PutsTheTargetInTheMiddleAndTheEdgesOfTheFieldAtTheEdges) {
  const Camera camera{.eye = {0.0, -4.0, 0.0}, .angle_rad = 2.0 * std::atan(0.25), .aspect = 2.0};
  const Projection project(camera);
  EXPECT_NEAR(project({0.0, 0.0, 0.0}).x, 0.0, 1e-15);
  EXPECT_NEAR(project({0.0, 0.0, 1.0}).y, 1.0, 1e-14);  // 4 away, slope 1/4.
  EXPECT_NEAR(project({2.0, 0.0, 0.0}).x, 2.0, 1e-14);
  EXPECT_NEAR(project({0.0, 4.0, 1.0}).y, 0.5, 1e-14);   // Twice as far, half as large.
  EXPECT_TRUE(std::isnan(project({0.0, -5.0, 1.0}).x));  // Behind the eye.
  EXPECT_NEAR(project.size_at({0.0, 0.0, 0.0}, 0.5), 0.5, 1e-14);
}

TEST(Projection, AParallelCameraKeepsLengths) {
  const Projection project(
      Camera{.eye = {0.0, 0.0, 9.0}, .up = {0.0, 1.0, 0.0}, .parallel = true, .height = 4.0});
  for (const double depth : {0.0, 5.0}) {
    EXPECT_NEAR(project({1.0, 2.0, depth}).x, 0.5, 1e-14);
    EXPECT_NEAR(project({1.0, 2.0, depth}).y, 1.0, 1e-14);
  }
}

TEST(Projection, AFittedCameraShowsAllPointsAndTouchesTheMargin) {
  const std::vector<Point3> cloud = {{0, 0, 0}, {3, 1, 0}, {1, 5, 2}, {2, 2, 9}, {-4, 0, 1}};
  for (const bool parallel : {false, true}) {
    const Projection project(fitted_camera(cloud, {1.0, -2.0, 1.0}, parallel, 1.5, 0.1));
    double most = 0.0;
    for (const Point3& p : cloud)
      most = std::max({most, std::abs(project(p).x) / 1.5, std::abs(project(p).y)});
    EXPECT_NEAR(most, 0.9, 1e-3) << parallel;
  }
}

/// Of a closed mesh, by the divergence theorem; negative if it is turned inside out.
double volume_of(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) / 6.0;
  return sum;
}

TEST(Solids, EncloseTheirVolumesWhereverTheyStand) {
  constexpr int kSides = 400;
  TriangleMesh rod, sphere, arrow;
  add_rod(rod, {3.0, 1.0, -2.0}, {3.0, 1.0, 5.0}, 0.5, kSides);
  EXPECT_NEAR(volume_of(rod), M_PI * 0.25 * 7.0, 1e-3);
  add_sphere(sphere, {-8.0, 2.0, 1.0}, 2.0, kSides);
  EXPECT_NEAR(volume_of(sphere), 4.0 / 3.0 * M_PI * 8.0, 1e-2);
  add_arrow(arrow, {1.0, 1.0, 1.0}, {4.0, 5.0, 1.0}, 0.1, kSides);  // A shaft of 4.6 and a head.
  EXPECT_NEAR(volume_of(arrow), M_PI * 0.01 * 4.6 + M_PI * 0.09 * 0.4 / 3.0, 1e-3);
}

TEST(Solids, HaveUnitNormalsAndNothingForNoLength) {
  TriangleMesh mesh;
  add_arrow(mesh, {0.0, 0.0, 0.0}, {0.1, 0.2, 0.3}, 0.5, 12);
  add_sphere(mesh, {0.0, 0.0, 0.0}, 1.0, 12);
  for (const Point3& n : mesh.normals) EXPECT_NEAR(n.norm(), 1.0, 1e-12);
  ASSERT_EQ(mesh.normals.size(), mesh.points.size());
  const std::size_t before = mesh.points.size();
  add_rod(mesh, {1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, 0.5, 12);
  EXPECT_EQ(mesh.points.size(), before);
}

TEST(SceneFigure, HasNothingThatAReaderWouldHoldAgainstIt) {
  for (const Scene& scene : sample_scenes())
    for (const Theme& theme : {report_theme(), paper_theme(3.25), paper_theme(6.75)}) {
      const auto found = flaws(lay_out(scene_figure(scene, theme), theme));
      EXPECT_TRUE(found.empty()) << scene.id << ", " << theme.name << ": " << found.front();
    }
}

TEST(SceneFigure, HasAColourBarWithTicksInPlaceOfAnEntryInTheLegend) {
  Scene scene = small_scene();
  Tones tones{.limits = {0.0, 0.48}, .bar_label = "error of the path [m]"};
  Tube tube{.label = "path", .points = {{0.1, 0.1, 0.1}, {0.9, 0.9, 0.1}}, .radius = 0.01};
  tones.values = {0.1, 0.4};
  tube.tones = tones;
  scene.parts = {tube};
  scene.views.resize(1);
  scene.views[0].parts.clear();
  std::vector<std::string> words;
  const Theme theme = report_theme();
  const Drawing drawing = lay_out(scene_figure(scene, theme), theme);
  for (const Item& item : drawing.items)
    if (const auto* line = std::get_if<TextLine>(&item.what);
        line != nullptr && item.item_class == ItemClass::kLegendText)
      words.push_back(line->shaped.text);
  const auto has = [&](const char* word) { return std::ranges::find(words, word) != words.end(); };
  EXPECT_TRUE(has("error of the path [m]"));
  EXPECT_TRUE(has("0.2") && has("0.4")) << "ticks";
  EXPECT_FALSE(has("path"));
}

TEST(Rooms, EndShortlyBelowTheirNearestCorner) {
  const Shot room = room_view(2.5, landmark_height(2.5));
  EXPECT_LT(Projection(room.camera)({2.5, 0.0, 0.0}).y, -0.85) << "the image ends at -1";
}

TEST(SceneFigure, LabelsStandInTheImageAndOffTheSolids) {
  const Theme theme = report_theme();
  const Figure figure = scene_figure(small_scene(), theme);
  const Drawing drawing = lay_out(figure, theme);
  const Box& frame = drawing.frames[0];
  const ImageLayer& image = std::get<ImageLayer>(figure.panels[0].layers[0]);
  const double unit = frame.height() / (image.y.high - image.y.low);
  const auto is_on_a_solid = [&](const Box& box) {
    for (std::size_t i = 0; i < image.clear_x.size(); ++i) {
      const double x = frame.x0 + (image.clear_x[i] - image.x.low) * unit;
      const double y = frame.y0 + (image.y.high - image.clear_y[i]) * unit;
      const double half = image.clear_by[i] * unit;
      if (box.x0 < x + half && x - half < box.x1 && box.y0 < y + half && y - half < box.y1)
        return true;
    }
    return false;
  };
  EXPECT_GT(image.clear_x.size(), 3U);
  int labels = 0;
  for (const Item& item : drawing.items) {
    const auto* line = std::get_if<TextLine>(&item.what);
    if (line == nullptr || (line->shaped.text != "σ² = ½" && line->shaped.text != "λ")) continue;
    ++labels;
    EXPECT_TRUE(frame.holds(text_box(*line)));
    EXPECT_FALSE(is_on_a_solid(text_box(*line))) << line->shaped.text;
  }
  EXPECT_EQ(labels, 2);
}

}  // namespace
}  // namespace mapproof::test
