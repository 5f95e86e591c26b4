#include <algorithm>
#include <regex>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = "scene-world-bearing";

/// A small study with its report, made once for all tests.
class ScenesOfAStudy : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder();
    made_ = mapproof({"reproduce", "yairi2007", "--profile", "quick", "--out", study()});
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string study() { return *folder_ / "study"; }

  /// One scene drawn again, in a folder of its own.
  static Contents drawn(const std::string& name) {
    const std::string out = *folder_ / name;
    const Outcome outcome = mapproof({"render", study(), "--figure", kScene, "--out", out});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return contents(out);
  }

  static inline TemporaryFolder* folder_ = nullptr;
  static inline Outcome made_;
};

TEST_F(ScenesOfAStudy, AreInItsReportWithWhatDrewThem) {
  ASSERT_EQ(made_.exit_code, 0) << made_.error;
  const std::string page = read_file(study() + "/report.html");
  for (const char* id :
       {"scene-scan-visibility", "scene-world-bearing", "scene-manifold-visibility"}) {
    EXPECT_NE(page.find(std::string("id=\"") + id), std::string::npos) << id;
    for (const char* extension : {".svg", ".png", ".pdf", ".scene.json"})
      EXPECT_TRUE(fs::exists(study() + "/figures/" + id + extension)) << id << extension;
  }
  EXPECT_NE(page.find("llvmpipe"), std::string::npos);
}

TEST_F(ScenesOfAStudy, AreLinkedToFilesThatAreThereAsAllImagesAre) {
  const std::string page = read_file(study() + "/report.html");
  const std::regex link("href=\"(figures/[^\"]*)\"");
  int links = 0;
  for (std::sregex_iterator found(page.begin(), page.end(), link), end; found != end; ++found) {
    ++links;
    EXPECT_TRUE(fs::exists(study() + "/" + (*found)[1].str())) << (*found)[1];
  }
  EXPECT_GT(links, 100);
}

TEST_F(ScenesOfAStudy, AreTheSameBytesWithoutADisplayAndForAnyThreads) {
  const Contents usual = drawn("usual");
  EXPECT_EQ(usual.size(), 4U);
  for (const auto& [name, bytes] : usual)
    EXPECT_EQ(bytes, read_file(study() + "/figures/" + name)) << name;
  {
    const Environment none{{"DISPLAY", nullptr}};
    expect_same(usual, drawn("no-display"));
  }
  {
    const Environment one{{"DISPLAY", ":4711"}, {"LP_NUM_THREADS", "0"}};
    expect_same(usual, drawn("one-thread"));
  }
  const Environment other{{"LP_NUM_THREADS", "7"},
                          {"GALLIUM_DRIVER", "softpipe"},
                          {"LP_NATIVE_VECTOR_WIDTH", "512"},
                          {"MESA_SHADER_CACHE_DISABLE", "true"}};
  expect_same(usual, drawn("other-driver"));
}

TEST_F(ScenesOfAStudy, ThatCannotBeDrawnAreOneLineAndCodeThree) {
  const Environment missing{{"MAPPROOF_SCENES", "/nowhere/mapproof-scenes"}};
  const std::string out = *folder_ / "none";
  const Outcome outcome = mapproof({"render", study(), "--figure", kScene, "--out", out});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.error,
            "mapproof: scenes cannot be drawn: /nowhere/mapproof-scenes is not a program: No such "
            "file or directory\n");
  EXPECT_TRUE(!fs::exists(out) || contents(out).empty());
}

TEST_F(ScenesOfAStudy, AreDrawnOnceThoughNamedTwice) {
  const std::string out = *folder_ / "twice";
  const Outcome outcome = mapproof({"render", study(), "--figure", "map-bearing-isomap", "--figure",
                                    "map-bearing-isomap", "--out", out, "--jobs", "4"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(outcome.out, out + "/map-bearing-isomap.svg\n");
}

TEST_F(ScenesOfAStudy, MoveWhereThatIsAskedForAndNothingElseIsDrawn) {
  const std::string out = *folder_ / "film";
  const Outcome outcome =
      mapproof({"render", study(), "--animate", "scene-forming-bearing", "--out", out, "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const Contents files = contents(out);
  ASSERT_EQ(files.size(), 1U);
  EXPECT_EQ(files[0].first, "scene-forming-bearing.apng");
  EXPECT_NE(files[0].second.find("acTL"), std::string::npos);
  EXPECT_NE(outcome.out.find("\"animations\""), std::string::npos);
  EXPECT_NE(outcome.out.find("\"figures\""), std::string::npos);
  const Outcome unknown = mapproof({"render", study(), "--animate", "map-bearing-isomap"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.error.find("scene-forming-bearing"), std::string::npos) << unknown.error;
  const Environment missing{{"MAPPROOF_ANIMATION", "/nowhere/mapproof-animation"}};
  EXPECT_EQ(mapproof({"render", study(), "--animate", "scene-forming-bearing", "--out",
                      *folder_ / "no-film"})
                .exit_code,
            3);
}

TEST_F(ScenesOfAStudy, OfARoomThatCannotBeDrawnAreLeftOut) {
  const fs::path copy = *folder_ / "odd";
  fs::copy(study(), copy, fs::copy_options::recursive);
  for (const auto& entry : fs::directory_iterator(copy / "runs")) {
    std::string text = read_file(entry.path());
    const std::string key = "\"landmark_diameter_m\": ";
    text.replace(text.find(key), key.size() + 5, key + "7.48 ");
    write_file(entry.path(), text);
  }
  const Outcome outcome = mapproof(
      {"render", copy.string(), "--figure", "map-bearing-isomap", "--figure", "errors-bearing"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(mapproof({"render", copy.string(), "--figure", "scene-world-bearing"}).exit_code, 2);
}

/// What `map` writes with that program to draw scenes.
Outcome map_of_hall(const TemporaryFolder& folder, const std::string& scenes) {
  const Environment drawn{{"MAPPROOF_SCENES", scenes.c_str()}};
  EXPECT_EQ(mapproof({"example", "hall", "--out", folder / "hall"}).exit_code, 0);
  const std::string hall = folder / "hall/hall";
  return mapproof({"map", hall + "/bearings.csv", "--sensor", "bearing", "--method", "isomap",
                   "--anchors", hall + "/anchors.csv", "--out", folder / "map", "--force"});
}

std::string scenes_beside_program() {
  return fs::path(program()).parent_path() / "mapproof-scenes";
}

TEST(SceneOfAMap, StandsInItsPageAndAmongItsSmallImages) {
  const TemporaryFolder folder;
  const Outcome outcome = map_of_hall(folder, scenes_beside_program());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  for (const char* ending : {".png", ".svg", ".pdf", ".scene.json"})
    EXPECT_TRUE(fs::exists(folder / ("map/figures/scene-map" + std::string(ending)))) << ending;
  const std::string page = read_file(folder / "map/report.html");
  EXPECT_NE(page.find("id=\"figure-scene-map\""), std::string::npos);
  EXPECT_NE(page.find("<li><a href=\"#figure-scene-map\">"), std::string::npos);
  const std::string scene = read_file(folder / "map/figures/scene-map.scene.json");
  EXPECT_NE(scene.find("\"anchor\""), std::string::npos);
}

TEST(SceneOfAMap, IsNoneWithoutTheProgramAndAWarningWhereThatFails) {
  const TemporaryFolder folder;
  EXPECT_EQ(map_of_hall(folder, "/nowhere/mapproof-scenes").exit_code, 0);
  EXPECT_FALSE(fs::exists(folder / "map/figures/scene-map.svg"));
  EXPECT_EQ(read_file(folder / "map/report.html").find("scene-map"), std::string::npos);
  const Outcome failed = map_of_hall(folder, "/bin/false");
  EXPECT_EQ(failed.exit_code, 0) << failed.error;
  EXPECT_NE(failed.error.find("\nwarning: scenes cannot be drawn: "), std::string::npos)
      << failed.error;
  EXPECT_NE(read_file(folder / "map/report.html").find("figure-map"), std::string::npos);
}

TEST_F(ScenesOfAStudy, AreNoConcernOfWhatDrawsNone) {
  const Environment missing{{"MAPPROOF_SCENES", "/nowhere/mapproof-scenes"}};
  EXPECT_EQ(mapproof({"methods"}).exit_code, 0);
  EXPECT_EQ(
      mapproof({"render", study(), "--figure", "map-bearing-isomap", "--out", *folder_ / "figure"})
          .exit_code,
      0);
}

}  // namespace
}  // namespace mapproof::test
