#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/cairo/cairo_backend.hpp"
#include "render/output/write_scene.hpp"
#include "render/scene/projection.hpp"
#include "render/svg/svg.hpp"
#include "render/theme/palette.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/images/baselines.hpp"
#include "tests/support/samples/sample_scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

Image drawn(SceneClient& client, const Scene& scene, int samples = 4) {
  return client.draw(scene, scene_request(0, 320, 240, samples, report_theme()));
}

SceneClient client() { return SceneClient(MAPPROOF_SCENES_PROGRAM); }

/// The programs that were built, each with another way to a context; MAPPROOF_SCENES_PROGRAM first.
std::vector<std::string> programs() {
  std::vector<std::string> all;
  std::istringstream list(MAPPROOF_SCENES_PROGRAMS);
  for (std::string one; std::getline(list, one, ':');) all.push_back(one);
  return all;
}

/// Once for each of the programs.
class ScenePixelsByEachWay : public ::testing::TestWithParam<std::string> {
 protected:
  static SceneClient client() { return SceneClient(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(EveryProgram, ScenePixelsByEachWay, ::testing::ValuesIn(programs()),
                         [](const auto& program) {
                           std::string name = std::filesystem::path(program.param).filename();
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(ScenePixelsByEachWay, AreTheSameInEveryProcessForAnyThreadsAndAnyDisplay) {
  const Scene scene = small_scene();  // Translucent parts too.
  std::vector<std::uint32_t> first;
  for (const int samples : {0, 4})
    for (const char* threads : {"0", "1", "7"}) {
      const Environment number{{"LP_NUM_THREADS", threads}};
      const Environment overruled{{"LP_NATIVE_VECTOR_WIDTH", "256"},
                                  {"GALLIUM_DRIVER", "softpipe"},
                                  {"LIBGL_ALWAYS_SOFTWARE", "0"},
                                  {"EGL_PLATFORM", "x11"},
                                  {"__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere.json"}};
      const Environment display{{"DISPLAY", samples == 0 ? nullptr : ":99.7"}};
      SceneClient one = client();
      const Image image = drawn(one, scene, samples);
      if (std::string(threads) == "0") first = image.pixels;
      EXPECT_EQ(image.pixels, first) << samples << " samples, " << threads << " threads";
    }
}

TEST(ScenePixels, AreTheSameByEveryWayToAContext) {
  const std::vector<std::string> all = programs();
  if (all.size() < 2) GTEST_SKIP() << "this build has one way alone: " << all.at(0);
  SceneClient first(all[0]);
  for (std::size_t i = 1; i < all.size(); ++i) {
    SceneClient other(all[i]);
    for (const Scene& scene : sample_scenes())
      for (const int samples : {0, 4})
        EXPECT_EQ(drawn(other, scene, samples).pixels, drawn(first, scene, samples).pixels)
            << scene.id << " by " << all[i];
    EXPECT_EQ(other.renderer(), first.renderer());
  }
}

TEST_P(ScenePixelsByEachWay, DoNotDependOnWhatWasDrawnBefore) {
  SceneClient one = client(), other = client();
  const Image alone = drawn(one, small_scene());
  for (const Scene& scene : sample_scenes())
    other.draw(scene, scene_request(0, 200, 300, 0, report_theme()));
  EXPECT_EQ(drawn(other, small_scene()).pixels, alone.pixels);
}

TEST_P(ScenePixelsByEachWay, InOtherColoursOfTheSameLightAreThoseDrawnAlone) {
  SceneClient one = client(), other = client();
  for (const Scene& scene : sample_scenes()) {
    const SceneRequest dark = scene_request(0, 320, 240, 4, dark_theme());
    drawn(one, scene);
    EXPECT_EQ(one.draw(scene, dark).pixels, other.draw(scene, dark).pixels) << scene.id;
    EXPECT_EQ(drawn(one, scene).pixels, drawn(other, scene).pixels) << scene.id;
  }
}

TEST(ScenePixels, OfAFloorInTheDarkDifferFromBothEndsOfARamp) {
  const std::vector<Scene> scenes = sample_scenes();
  const auto world = std::ranges::find(scenes, "world-usual", &Scene::id);
  ASSERT_NE(world, scenes.end());
  const Theme dark = dark_theme();
  const Image image = client().draw(*world, scene_request(0, 320, 240, 4, dark));
  std::map<std::uint32_t, int> counts;
  for (const std::uint32_t pixel : image.pixels) ++counts[pixel & 0xFFFFFF];
  counts.erase(image.pixels.front() & 0xFFFFFF);  // The background.
  const Colour floor = colour(
      std::ranges::max_element(counts, {}, [](const auto& one) { return one.second; })->first);
  EXPECT_GE(contrast(floor, viridis(0.0)), 2.0);
  EXPECT_GE(contrast(floor, viridis(1.0)), 4.0);
}

TEST(SceneDrawingTest, HasDarkImagesForAPageAlone) {
  SceneClient one = client();
  const Theme dark = dark_theme();
  const SceneDrawing drawing = draw_scene(small_scene(), baseline_theme(), one, &dark);
  ASSERT_TRUE(drawing.page);
  const std::string file = to_svg(drawing.screen), page = to_svg(*drawing.page);
  EXPECT_EQ(file.find("data-dark"), std::string::npos);
  EXPECT_NE(page.find("data-dark=\""), std::string::npos);
  EXPECT_LT(page.size(), file.size() * 3 / 2);
  for (const Item& item : drawing.page->items)
    if (const auto* raster = std::get_if<Raster>(&item.what)) {
      ASSERT_NE(raster->dark, nullptr);
      EXPECT_EQ(raster->dark->width, raster->image->width);
      EXPECT_EQ(raster->dark->row(0)[0] & 0xFFFFFF, 0x15181CU);
    }
  EXPECT_FALSE(draw_scene(small_scene(), baseline_theme(), one).page);
}

TEST(SceneSizes, HaveBoundsInFilesWithImagesAlone) {
  Theme fine = baseline_theme();
  fine.dpi = 100'000.0;
  const Scene scene = small_scene();
  EXPECT_THROW(require_scene_size(scene, fine, {FileFormat::kSvg}), InvalidInput);
  EXPECT_NO_THROW(require_scene_size(scene, fine, {FileFormat::kMatplotlib, FileFormat::kJson}));
  EXPECT_NO_THROW(require_scene_size(scene, baseline_theme(), {FileFormat::kSvg}));
  EXPECT_THROW(require_film_size({.id = "film", .frames = {scene, scene}}, fine), InvalidInput);
  EXPECT_THROW(require_film_size({.id = "film", .frames = {}}, fine), InvalidInput);
}

/// The middle of all pixels that are not white.
Point middle_of_marks(const Image& image) {
  double x = 0.0, y = 0.0, count = 0.0;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      if ((image.row(row)[column] & 0xFFFFFF) != 0xFFFFFF)
        x += column + 0.5, y += row + 0.5, count += 1.0;
  return {x / count, y / count};
}

TEST(ScenePixels, StandWhereTheProjectionSays) {
  SceneClient one = client();
  for (const bool parallel : {false, true})
    for (const Point3& at :
         {Point3{0.9, 0.2, 0.4}, Point3{-0.8, 0.5, -0.3}, Point3{0.0, -0.9, 0.6}}) {
      Scene scene = small_scene();
      scene.parts = {Spheres{
          .at = {at}, .radius = 0.03, .style = {.colour = ThemeColour::kText, .lit = false}}};
      const std::vector<Point3> corners = {{-1, -1, -1}, {1, 1, 1}, {-1, 1, 1}, {1, -1, -1}};
      scene.views[0].camera = fitted_camera(corners, {0.7, -1.0, 0.5}, parallel);
      const Point p = Projection(scene.views[0].camera)(at);
      const Image image = one.draw(scene, scene_request(0, 960, 600, 0, report_theme()));
      const Point middle = middle_of_marks(image);
      EXPECT_NEAR(middle.x, 300.0 * (1.6 + p.x), 0.6);
      EXPECT_NEAR(middle.y, 300.0 * (1.0 - p.y), 0.6);
    }
}

TEST_P(ScenePixelsByEachWay, NameWhatDrewThem) {
  SceneClient one = client();
  EXPECT_EQ(one.renderer(), "");
  drawn(one, small_scene());
  EXPECT_NE(one.renderer().find("llvmpipe"), std::string::npos);
  EXPECT_NE(one.renderer().find("128 bits"), std::string::npos);
  EXPECT_NE(one.renderer().find("VTK 9"), std::string::npos);
}

/// Memory of the program that this one has started, MiB.
double memory_of_child_mib() {
  std::ifstream children("/proc/self/task/" + std::to_string(::getpid()) + "/children");
  std::string child, word;
  children >> child;
  std::ifstream status("/proc/" + child + "/status");
  while (status >> word)
    if (word == "VmRSS:") {
      double kib = 0.0;
      status >> kib;
      return kib / 1024.0;
    }
  return -1.0;
}

TEST_P(ScenePixelsByEachWay, TwoHundredOfThemLeaveNothingBehind) {
  SceneClient one = client();
  const Scene scene = small_scene();  // Has a part of every kind.
  const auto draw = [&](int images) {
    for (int i = 0; i < images; ++i)
      one.draw(scene, scene_request(0, 320 + 16 * (i % 5), 240, 4 * (i % 2), report_theme()));
    return memory_of_child_mib();
  };
  const double before = draw(80);  // Shaders and buffers of every size and kind.
  ASSERT_GT(before, 10.0);
  constexpr double kImage_mib = 320.0 * 240.0 * 3.0 / 1024.0 / 1024.0;
  EXPECT_LT(draw(200) - before, 200.0 * kImage_mib / 4.0);
}

TEST(SceneClient, SaysInOneLineThatTheProgramIsMissing) {
  SceneClient none("/nowhere/mapproof-scenes");
  try {
    drawn(none, small_scene());
    FAIL();
  } catch (const SceneError& error) {
    EXPECT_STREQ(
        error.what(),
        "scenes cannot be drawn: /nowhere/mapproof-scenes is not a program: No such file or "
        "directory");
  }
}

TEST_P(ScenePixelsByEachWay, AreNotThereWithoutAContextWhichIsSaidInOneLine) {
  const Environment stub{{"LD_PRELOAD", MAPPROOF_NO_CONTEXT}};  // Makes no context, ever.
  SceneClient one = client();
  for (int attempt = 0; attempt < 2; ++attempt) try {
      drawn(one, small_scene());
      FAIL();
    } catch (const SceneError& error) {
      EXPECT_TRUE(std::regex_match(
          error.what(),
          std::regex("scenes cannot be drawn: (OSMesa|EGL) makes no context of OpenGL 3.2")))
          << error.what();
    }
}

TEST(SceneClient, SaysThatTheProgramEndedWithoutAnAnswer) {
  SceneClient one("/bin/false");
  EXPECT_THROW(drawn(one, small_scene()), SceneError);
}

/// A program of these lines of the shell.
std::filesystem::path script(const TemporaryFolder& folder, const std::string& lines) {
  const std::filesystem::path path = folder.file("script", "#!/bin/sh\n" + lines + "\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

/// What is said of a scene that a script cannot draw.
std::string complaint(const std::string& lines, const Scene& scene = small_scene()) {
  const TemporaryFolder folder;
  SceneClient one(script(folder, lines), std::chrono::seconds(1));
  try {
    drawn(one, scene);
    return "nothing";
  } catch (const SceneError& error) {
    return error.what();
  }
}

TEST(SceneClient, SaysHowTheProgramEnded) {
  EXPECT_EQ(complaint("read line; exit 3"),
            "scenes cannot be drawn: script: it gave no answer; it ended with exit code 3");
  EXPECT_EQ(complaint("read line; kill -9 $$"),
            "scenes cannot be drawn: script: it gave no answer; it was ended by signal 9, perhaps "
            "for want of memory");
  EXPECT_EQ(complaint("echo one >&2; echo 'script: two' >&2; read line; exit 1"),
            "scenes cannot be drawn: script: two");
}

TEST(SceneClient, DoesNotWaitForEverForAProgramThatHangs) {
  const std::string hangs = "scenes cannot be drawn: script: it gave no answer within 1 s";
  EXPECT_EQ(complaint("exec sleep 100"), hangs);
  Scene large = small_scene();  // More than a socket holds that nobody reads.
  large.parts.push_back(
      Spheres{.at = std::vector<Point3>(100'000, Point3{0, 0, 0}), .radius = 0.1});
  EXPECT_EQ(complaint("exec sleep 100", large), hangs);
}

TEST(SceneClient, RefusesWhatCannotBeDrawnAndGoesOn) {
  SceneClient one = client();
  Scene bad = small_scene();
  bad.views.clear();
  EXPECT_THROW(drawn(one, bad), InvalidInput);
  EXPECT_THROW(one.draw(small_scene(), scene_request(0, 0, 10, 0, report_theme())), InvalidInput);
  EXPECT_THROW(one.draw(small_scene(), scene_request(5, 10, 10, 0, report_theme())), InvalidInput);
  EXPECT_EQ(drawn(one, small_scene()).width, 320);
}

TEST(SceneBaseline, IsMatched) {
  SceneClient one = client();
  for (const Scene& scene : sample_scenes()) {
    const SceneDrawing drawing = draw_scene(scene, baseline_theme(), one);
    EXPECT_EQ(difference_from_baseline("scene-" + scene.id, to_image(drawing.screen)), "");
  }
}

}  // namespace
}  // namespace mapproof::test
