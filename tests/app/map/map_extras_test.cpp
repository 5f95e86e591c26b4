#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/records/maps/map_json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

/// Noisy bearings of 12 posts from a robot that wanders among them.
struct Survey {
  Points posts = grid(3, 4);
  Points robot = 4.0 * scattered(300, 3);

  std::string rows(Eigen::Index first, Eigen::Index last) const {
    std::string csv;
    for (Eigen::Index t = first; t < last; ++t)
      for (Eigen::Index i = 0; i < posts.rows(); ++i)
        csv += fmt::format("{},post {},{}\n", t, i,
                           std::atan2(posts(i, 1) - robot(t, 1), posts(i, 0) - robot(t, 0)));
    return csv;
  }
  std::string file() const { return "step,landmark,value\n" + rows(0, robot.rows()); }
  std::string anchors() const {
    std::string csv = "name,x,y\n";
    for (const Eigen::Index i : {0, 3, 8, 11})
      csv += fmt::format("post {},{},{}\n", i, posts(i, 0), posts(i, 1));
    return csv;
  }
};

nlohmann::json result_of(const Outcome& outcome) { return nlohmann::json::parse(outcome.out); }

MapRecord map_in(const std::string& folder) {
  const std::string path = folder + "/map.json";
  return parse_map(read_file(path), path);
}

TEST(MapEllipses, AreInEveryOutputAndTheSameAgain) {
  const TemporaryFolder folder;
  const Survey survey;
  const std::string file = folder.file("bearings.csv", survey.file());
  const std::string anchors = folder.file("anchors.csv", survey.anchors());
  const auto run = [&](const std::string& out) {
    return mapproof({"map", file, "--sensor", "bearing", "--method", "smacof", "--anchors", anchors,
                     "--ellipses", "30", "--out", out, "--json"});
  };
  const Outcome outcome = run(folder.path() / "one");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto landmarks = result_of(outcome)["landmarks"];
  for (const auto& landmark : landmarks) {
    EXPECT_GE(landmark["ellipse"]["a_m"], landmark["ellipse"]["b_m"]);
    EXPECT_LT(landmark["ellipse"]["a_m"], 1.0);
  }
  const std::string text = read_file(folder.path() / "one" / "map.json");
  EXPECT_EQ(parse_map_uncertainty(text, "map.json")->replicates, 30);
  EXPECT_NE(read_file(folder.path() / "one" / "map.csv").find(",ellipse_a_m,"), std::string::npos);
  EXPECT_NE(read_file(folder.path() / "one/figures/map.svg").find("ellipse-5"), std::string::npos);
  EXPECT_NE(read_file(folder.path() / "one/report.html").find("Uncertainty of each landmark"),
            std::string::npos);
  EXPECT_EQ(mapproof({"validate", folder / "one"}).exit_code, 0);
  ASSERT_EQ(run(folder.path() / "two").exit_code, 0);
  EXPECT_EQ(read_file(folder.path() / "two" / "map.json"), text);
}

TEST(MapEllipses, NeedTenDrawsAndTakeTwoHundredIfNoneAreGiven) {
  const TemporaryFolder folder;
  const std::string file = folder.file("bearings.csv", Survey().file());
  EXPECT_EQ(mapproof({"map", file, "--sensor", "bearing", "--ellipses", "9", "--out",
                      folder.path() / "few"})
                .exit_code,
            2);
  const Outcome usual = mapproof({"map", file, "--sensor", "bearing", "--method", "lpca", "--out",
                                  folder.path() / "usual", "--ellipses"});
  ASSERT_EQ(usual.exit_code, 0) << usual.error;
  const std::string text = read_file(folder.path() / "usual" / "map.json");
  EXPECT_EQ(parse_map_uncertainty(text, "map.json")->replicates, 200);
}

TEST(MapAuto, SaysWhatItComparedAndTakesTheFirst) {
  const TemporaryFolder folder;
  const Survey survey;
  const std::string file = folder.file("bearings.csv", survey.file());
  const std::string anchors = folder.file("anchors.csv", survey.anchors());
  const Outcome outcome =
      mapproof({"map", file, "--sensor", "bearing", "--method", "auto", "--anchors", anchors,
                "--out", folder.path() / "out", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const nlohmann::json result = result_of(outcome);
  const nlohmann::json& candidates = result["choice"]["candidates"];
  EXPECT_GT(candidates.size(), 10U);
  EXPECT_EQ(candidates[0]["method"], result["method"]);
  EXPECT_EQ(candidates[0]["parameter"], result["parameter"]);
  EXPECT_NE(read_file(folder.path() / "out/report.html").find("Why this method"),
            std::string::npos);
  EXPECT_EQ(mapproof({"map", file, "--sensor", "bearing", "--method", "auto", "-K", "5", "--out",
                      folder.path() / "other"})
                .exit_code,
            2);
}

/// Waits until an incremental map has so many steps.
bool reaches(const std::string& folder, int steps) {
  for (int tries = 0; tries < 600; ++tries) {
    if (fs::exists(folder + "/map.json") && map_in(folder).step >= steps) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

TEST(MapIncremental, GoesOnWithAFileAndEndsWithTheMapOfTheWhole) {
  const TemporaryFolder folder;
  const Survey survey;
  const std::string file = folder.file("live.csv", "step,landmark,value\n" + survey.rows(0, 100));
  const std::string anchors = folder.file("anchors.csv", survey.anchors());
  const std::string out = folder.path() / "out";
  const pid_t process =
      start_mapproof({"map", file, "--incremental", "--every", "20", "--sensor", "bearing",
                      "--method", "smacof", "--anchors", anchors, "--out", out});
  ASSERT_TRUE(reaches(out, 99));
  std::ofstream(file, std::ios::app) << survey.rows(100, 300) << "300,post 1,0.";
  ASSERT_TRUE(reaches(out, 299));
  ::kill(process, SIGTERM);
  int status = 0;
  ::waitpid(process, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_TRUE(fs::exists(out + "/report.html"));

  const std::string all = folder.file("all.csv", survey.file());
  ASSERT_EQ(mapproof({"map", all, "--sensor", "bearing", "--method", "smacof", "--anchors", anchors,
                      "--out", folder.path() / "whole"})
                .exit_code,
            0);
  const MapRecord incremental = map_in(out), whole = map_in(folder.path() / "whole");
  EXPECT_EQ(incremental.step, 300);
  EXPECT_EQ(incremental.frame, Frame::kGroundTruth);
  EXPECT_LT((incremental.estimate - whole.estimate).cwiseAbs().maxCoeff(), 1e-6);
}

TEST(MapIncremental, EndsWithARemarkWhereTheFileIsCutShort) {
  const TemporaryFolder folder;
  const Survey survey;
  const std::string file = folder.file("live.csv", survey.rows(0, 50));
  const std::string out = folder.path() / "out";
  const pid_t process = start_mapproof({"map", file, "--incremental", "--every", "10", "--sensor",
                                        "bearing", "--method", "lpca", "--out", out});
  ASSERT_TRUE(reaches(out, 49));
  std::ofstream(file, std::ios::trunc) << "0,post 1,0.5\n";
  int status = 0;
  ::waitpid(process, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_NE(read_file(out + "/report.html").find("was cut short, removed or replaced"),
            std::string::npos);
}

TEST(MapIncremental, NeedsAKindAndAKnownInterval) {
  const TemporaryFolder folder;
  const std::string file = folder.file("long.csv", Survey().rows(0, 20));
  const std::string out = folder.path() / "out";
  EXPECT_EQ(mapproof({"map", file, "--incremental", "--out", out}).exit_code, 2);
  for (const char* every : {"0", "1.5", "s", "-3s", "soon"})
    EXPECT_EQ(mapproof({"map", file, "--incremental", "--sensor", "bearing", "--out", out,
                        "--every", every})
                  .exit_code,
              2)
        << every;
}

}  // namespace
}  // namespace mapproof::test
