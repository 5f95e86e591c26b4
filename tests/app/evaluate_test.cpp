#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Trajectories of examples/trajectories/make_trajectories.py.
class Trajectories : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string script =
        std::string(MAPPROOF_SOURCE_DIR) + "/examples/trajectories/make_trajectories.py";
    const Outcome made = run_program({"python3", script, folder_.path()});
    if (made.exit_code == 127) GTEST_SKIP() << "python3 is not installed";
    ASSERT_EQ(made.exit_code, 0) << made.error;
  }

  std::string at(const std::string& name) const { return folder_ / name; }

  Outcome evaluate(const std::string& out, std::vector<std::string> more = {}) const {
    std::vector<std::string> words = {"evaluate",      "--ground-truth", at("ground-truth"),
                                      at("stretched"), at("shifted"),    "--align",
                                      "none",          "--out",          at(out)};
    words.insert(words.end(), more.begin(), more.end());
    return mapproof(words);
  }

  TemporaryFolder folder_;
};

void expect_close(double found, double expected, const std::string& what) {
  EXPECT_NEAR(found, expected, 1e-9 * expected + 1e-12) << what;
}

TEST_F(Trajectories, HaveTheErrorsOfTheirClosedForms) {
  const Outcome outcome = evaluate("out", {"--relative", "10f", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json result = json::parse(outcome.out);
  const json expected = json::parse(read_file(at("expected.json")));
  ASSERT_EQ(result.at("runs").size(), expected.size());
  for (const json& run : result.at("runs")) {
    const std::string name =
        run.at("system").get<std::string>() + "/" + run.at("run").get<std::string>();
    const json& numbers = expected.at(name);
    for (const auto& [key, value] : numbers.at("ate").items())
      expect_close(run.at("path").at("ate").at(key), value, name + " " + key);
    const json& relative = run.at("path").at("relative").at(0);
    expect_close(relative.at("rpe").at("rmse_m"), numbers.at("rpe_10_poses_m"), name + " RPE");
  }
}

TEST_F(Trajectories, BecomeAStudyThatEveryCommandTakes) {
  ASSERT_EQ(evaluate("out").exit_code, 0);
  for (const char* file :
       {"report.html", "results.csv", "errors/helix/shifted.csv",
        "figures/evaluation-errors-helix-path-1.svg", "figures/evaluation-errors-helix-curves.png",
        "figures/evaluation-errors-line-distribution.pdf", "tables/evaluation-poses-means.csv"})
    EXPECT_TRUE(fs::exists(at("out") + "/" + file)) << file;
  EXPECT_EQ(mapproof({"validate", at("out")}).exit_code, 0);
  const Contents before = contents(at("out"));
  ASSERT_EQ(mapproof({"report", at("out")}).exit_code, 0);
  expect_same(before, contents(at("out")));
  const std::string page = read_file(at("out") + "/report.html");
  EXPECT_NE(page.find("sequences; each estimate is as it came."), std::string::npos);
  EXPECT_NE(page.find("best mean of ATE (RMSE), absolute errors"), std::string::npos);
  ASSERT_EQ(evaluate("out").exit_code, 0);
  EXPECT_EQ(page, read_file(at("out") + "/report.html"));
  ASSERT_EQ(evaluate("again").exit_code, 0);
  EXPECT_EQ(mapproof({"diff", at("out"), at("again"), "--page", at("diff.html")}).exit_code, 0);
  const Outcome nightly = mapproof({"nightly", at("out"), "--store", at("store")});
  EXPECT_EQ(nightly.exit_code, 0) << nightly.error;
}

TEST_F(Trajectories, OfAWorseSystemAreFoundByDiff) {
  ASSERT_EQ(evaluate("out").exit_code, 0);
  // The ground truth of the line is 2 % longer than the estimate.
  std::string longer;
  for (int i = 0; i < 101; ++i) longer += fmt::format("{} {} 0 0 0 0 0 1\n", i, 1.02 * i);
  write_file(at("stretched") + "/line.txt", longer);
  ASSERT_EQ(evaluate("worse").exit_code, 0);
  EXPECT_EQ(mapproof({"diff", at("out"), at("worse"), "--page", at("diff.html")}).exit_code, 1);
}

TEST_F(Trajectories, ALostSequenceIsLostAndNamed) {
  fs::remove(at("shifted") + "/helix.txt");
  const Outcome outcome = evaluate("out");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.error.find("shifted: has no file of helix: lost"), std::string::npos)
      << outcome.error;
  EXPECT_NE(read_file(at("out") + "/results.csv").find("poses,shifted,ate_rmse_m,helix,helix,,,"),
            std::string::npos);
}

TEST_F(Trajectories, SeveralFilesOfASystemAreItsRuns) {
  const std::string line = at("stretched") + "/line.txt";
  const Outcome outcome = mapproof({"evaluate", "--ground-truth", at("ground-truth") + "/line.txt",
                                    "a=" + line, "a=" + at("shifted") + "/line.txt", "b=" + line,
                                    "b=" + at("ground-truth") + "/line.txt", "--align", "none", "--out", at("out")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const std::string table = read_file(at("out") + "/tables/evaluation-poses-means.csv");
  EXPECT_NE(outcome.out.find("a, line-2"), std::string::npos) << outcome.out;
  EXPECT_TRUE(fs::exists(at("out") + "/figures/evaluation-poses-ate-rmse-m.svg"));
  EXPECT_FALSE(table.empty());
}

TEST_F(Trajectories, BadInputIsOneLineAndLeavesNoFolder) {
  write_file(at("bad.txt"), "1 2 3\n");
  const std::string line = at("ground-truth") + "/line.txt";
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{at("bad.txt")},
                                             {at("missing.txt")},
                                             {line, "--relative", "5"},
                                             {line, "--gate", "1"},
                                             {line, "--name", "Not an id"}}) {
    std::vector<std::string> all = {"evaluate", "--ground-truth", line, "--out", at("out")};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = mapproof(all);
    EXPECT_EQ(outcome.exit_code, 2) << fmt::format("{}: {}", words.back(), outcome.error);
    EXPECT_FALSE(fs::exists(at("out"))) << words.back();
  }
  const Outcome other =
      mapproof({"evaluate", "--ground-truth", line, line, "--out", at("stretched")});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_TRUE(fs::exists(at("stretched") + "/line.txt"));
}

/// Along x at 1 m/s; the estimate is 3 m to the left and 4 m up.
TEST(EvaluatedPaths, InThePlaneAreReadByTheirHeader) {
  const TemporaryFolder folder;
  std::string ground_truth = "t,x,y,heading\n", estimate;
  for (int i = 0; i < 30; ++i) {
    ground_truth += fmt::format("{0},{0},0,0\n", i);
    estimate += fmt::format("{0} {0} 3 4 0 0 0 1\n", i);
  }
  const std::string ground_truth_file = folder.file("groundtruth.csv", ground_truth);
  const std::string estimate_file = folder.file("est.txt", estimate);
  const auto rmse_m = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"evaluate", "--ground-truth", ground_truth_file, estimate_file,
                                      "--align", "none", "--json", "--out", folder / "out"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = mapproof(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    return json::parse(outcome.out).at("runs").at(0).at("path");
  };
  expect_close(rmse_m({}).at("ate").at("rmse_m"), 5.0, "in space");
  expect_close(rmse_m({"--plane", "xy"}).at("ate").at("rmse_m"), 3.0, "xy");
  expect_close(rmse_m({"--plane", "xz"}).at("ate").at("rmse_m"), 4.0, "xz");
  const json all = rmse_m({"--relative", "5m", "--all-pairs"}).at("relative").at(0);
  EXPECT_EQ(all.at("pairs"), 25);
  EXPECT_EQ(rmse_m({"--relative", "5m"}).at("relative").at(0).at("pairs"), 4);
}

TEST(EvaluatedPaths, OfThePlaneAreRefusedWithoutAPosition) {
  const TemporaryFolder folder;
  const std::string file = folder.file("groundtruth.csv", "t,x,y\n0,0,0\n1,,0\n2,2,0\n");
  const Outcome outcome =
      mapproof({"evaluate", "--ground-truth", file, file, "--out", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find(file), std::string::npos) << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(EvaluatedMaps, AreComparedByIdAndByPosition) {
  const TemporaryFolder folder;
  write_file(folder / "real.csv", "name,x,y\na,0,0\nb,4,0\nc,0,3\nd,9,7\n");
  write_file(folder / "map.csv", "name,x,y\na,1,0\nb,5,0\nc,1,3\n");
  write_file(folder / "unnamed.csv", "name,x,y\n1,0,1\n2,0,5\n3,-3,1\n");
  const Outcome by_id =
      mapproof({"evaluate", "--ground-truth", folder / "real.csv", folder / "map.csv", "--align",
                "none", "--out", folder / "id", "--json"});
  ASSERT_EQ(by_id.exit_code, 0) << by_id.error;
  const json named = json::parse(by_id.out).at("runs").at(0).at("landmarks");
  EXPECT_DOUBLE_EQ(named.at("errors").at("mean_m"), 1.0);
  EXPECT_EQ(named.at("missed"), 1);
  EXPECT_TRUE(fs::exists(folder / "id/figures/evaluation-map-map-real.svg"));
  const Outcome nearest =
      mapproof({"evaluate", "--ground-truth", folder / "real.csv", folder / "unnamed.csv",
                "--landmarks", "nearest", "--gate", "0.1", "--out", folder / "nearest", "--json"});
  ASSERT_EQ(nearest.exit_code, 0) << nearest.error;
  const json found = json::parse(nearest.out).at("runs").at(0).at("landmarks");
  EXPECT_NEAR(found.at("errors").at("mean_m"), 0.0, 1e-12);
  const Outcome without = mapproof({"evaluate", "--ground-truth", folder / "real.csv",
                                    folder / "unnamed.csv", "--out", folder / "without"});
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.error.find("--landmarks nearest"), std::string::npos) << without.error;
}

}  // namespace
}  // namespace mapproof::test
