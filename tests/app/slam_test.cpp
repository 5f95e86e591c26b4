#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/child_process.hpp"
#include "core/base/files/files.hpp"
#include "tests/app/range_logs.hpp"
#include "tests/support/plaza.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The part of a result on one method.
json method_of(const json& result, const std::string& name) {
  for (const json& method : result.at("methods"))
    if (method.at("method") == name) return method;
  return nullptr;
}

double mean_error(const json& result, const std::string& name) {
  return method_of(result, name).at("errors").at(0).at("path_mean_m").get<double>();
}

TEST(Slam, MapsALogAndWritesPathLandmarksFiguresAndReport) {
  const TemporaryFolder folder;
  write_log(drive_log(), folder / "log");
  const Outcome outcome =
      mapproof({"slam", folder / "log", "--name", "Round", "--out", folder / "out", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json result = json::parse(outcome.out);
  EXPECT_EQ(result.at("name"), "Round");
  EXPECT_EQ(result.at("landmarks").size(), 6U);
  EXPECT_GT(result.at("window_s").get<double>(), 0.0);
  EXPECT_LT(mean_error(result, "spectral"), 0.5);
  EXPECT_LT(mean_error(result, "refined"), 0.1);
  EXPECT_NEAR(method_of(result, "refined").at("range_scale").get<double>(), 1.05, 0.01);
  for (const char* file : {"slam.json", "landmarks.csv", "path.csv", "path.tum", "report.html",
                           "paths/groundtruth.csv", "paths/spectral.tum"})
    EXPECT_TRUE(fs::exists(folder / "out" / file)) << file;
  EXPECT_EQ(mapproof({"validate", folder / "out", folder / "log"}).exit_code, 0);
}

TEST(Slam, WithoutAGroundTruthClaimsNoError) {
  const TemporaryFolder folder;
  write_log(drive_log(), folder / "log",
            {.odometry = true, .ground_truth = false, .landmarks = false});
  const Outcome outcome = mapproof({"slam", folder / "log", "--out", folder / "out", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json result = json::parse(outcome.out);
  for (const json& method : result.at("methods"))
    EXPECT_TRUE(method.at("errors").empty()) << method;
  EXPECT_NE(outcome.error.find("The true path is not known"), std::string::npos) << outcome.error;
}

TEST(Slam, GroundTruthOdometryAndKnownLandmarksMayStandInFilesOfTheirOwn) {
  const TemporaryFolder folder;
  write_log(drive_log(), folder / "whole");
  write_log(drive_log(), folder / "log",
            {.odometry = false, .ground_truth = false, .landmarks = false});
  const Outcome outcome =
      mapproof({"slam", folder / "log", "--odometry", folder / "whole/odometry.csv", "--truth",
                folder / "whole/groundtruth.csv", "--anchors", folder / "whole/landmarks.csv",
                "--out", folder / "out", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json result = json::parse(outcome.out);
  EXPECT_LT(mean_error(result, "spectral-known"), 0.5);
  EXPECT_EQ(method_of(result, "refined").at("errors").at(0).at("alignment"), "none");
  EXPECT_LT(mean_error(result, "refined"), 0.1);
}

TEST(Slam, SaysWhatItLeavesOutOfAnchors) {
  const TemporaryFolder folder;
  const RangeLog log = log_of_common_times();
  write_log(log, folder / "log");
  std::string anchors = "name,x,y,z_cm\n";
  for (Eigen::Index n = 0; n < 5; ++n)
    anchors += fmt::format("{},{},{},{}\n", log.landmarks[static_cast<std::size_t>(n)],
                           (*log.true_landmarks)(n, 0), (*log.true_landmarks)(n, 1), 50 * (n + 1));
  const Outcome outcome = mapproof({"slam", folder / "log", "--anchors",
                                    folder.file("anchors.csv", anchors), "--out", folder / "out"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.error.find("The heights in"), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find("(0.5 to 2.5 m) are not used"), std::string::npos);
  EXPECT_NE(outcome.error.find("Errors of landmarks are means over 1 landmark: the 5 anchors with "
                               "ground truth are left out."),
            std::string::npos)
      << outcome.error;
}

TEST(Slam, SpeedsThatAreNamedAsOdometryAreRefused) {
  const TemporaryFolder folder;
  write_file(folder / "log/ranges.csv", "t,beacon,range\n0.5,a,1\n1.5,b,2\n");
  const std::string odometry = folder.file("odometry.csv", "t,v_ms,omega_dps\n1,1,0\n2,1,0\n");
  const Outcome outcome =
      mapproof({"slam", folder / "log", "--odometry", odometry, "--columns",
                "distance=v_ms,heading_change=omega_dps", "--out", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("line 1: \"v_ms\" is a speed or a rate of turning; odometry is the "
                               "way [m] and the heading change [rad] since the row before"),
            std::string::npos)
      << outcome.error;
}

TEST(Slam, WithoutOdometrySaysWhatItCannotDoAndMapsWhatComesTogether) {
  const TemporaryFolder folder;
  write_log(log_of_common_times(), folder / "together");
  const Outcome outcome =
      mapproof({"slam", folder / "together", "--out", folder / "out", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.error.find("Without odometry"), std::string::npos) << outcome.error;
  const json result = json::parse(outcome.out);
  EXPECT_TRUE(result.at("window_s").is_null());
  EXPECT_EQ(method_of(result, "spectral").at("errors").at(0).at("alignment"),
            "rigid-with-reflection");
  // The path is straight between its times, a second apart; the ground truth is not.
  EXPECT_LT(mean_error(result, "spectral"), 0.05);

  write_log(drive_log(), folder / "apart", {.odometry = false});
  const Outcome apart = mapproof({"slam", folder / "apart", "--out", folder / "none"});
  EXPECT_EQ(apart.exit_code, 1) << apart.error;
  EXPECT_NE(apart.out.find("No method gave a map"), std::string::npos) << apart.out;
  const std::string last = last_line(apart.error);
  EXPECT_TRUE(last.starts_with("mapproof: " + (folder / "apart").string() + ": no map was made: "))
      << apart.error;
  EXPECT_NE(last.find(" are needed."), std::string::npos) << last;
  EXPECT_TRUE(fs::exists(folder / "none" / "report.html"));
}

TEST(Slam, OneLandmarkIsAStatusAndNoCrash) {
  const TemporaryFolder folder;
  RangeLog log = drive_log();
  log.landmarks.resize(1);
  std::erase_if(log.ranges, [](const RangeMeasurement& measured) { return measured.landmark > 0; });
  log.true_landmarks = Points(log.true_landmarks->topRows(1));
  write_log(log, folder / "log");
  const Outcome outcome = mapproof({"slam", folder / "log", "--out", folder / "out"});
  EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1) << outcome.error;
  EXPECT_NE(outcome.error.find("too_few_observations"), std::string::npos) << outcome.error;
}

TEST(Slam, MayBeRepeatedIntoItsFolderButNoOtherLogMay) {
  const TemporaryFolder folder;
  write_log(log_of_common_times(), folder / "a");
  RangeLog other = log_of_common_times();
  other.ranges[5].range_m += 0.01;
  write_log(other, folder / "b");
  ASSERT_EQ(mapproof({"slam", folder / "a", "--out", folder / "out"}).exit_code, 0);
  const auto before = contents(folder / "out");
  EXPECT_EQ(mapproof({"slam", folder / "a", "--out", folder / "out"}).exit_code, 0);
  const Outcome refused = mapproof({"slam", folder / "b", "--out", folder / "out"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.error.find("another log"), std::string::npos) << refused.error;
  EXPECT_EQ(contents(folder / "out").size(), before.size());
}

/// One thing wrong with a call of `slam`, and what the message has to contain.
struct BadSlam {
  std::string name;
  std::string ranges;
  std::string odometry;
  std::string known;
  std::string message;
};

std::ostream& operator<<(std::ostream& out, const BadSlam& bad) { return out << bad.name; }

class BadSlamInput : public ::testing::TestWithParam<BadSlam> {};

TEST_P(BadSlamInput, IsOneClearLineAndNothingWritten) {
  const TemporaryFolder folder;
  const BadSlam& bad = GetParam();
  if (!bad.ranges.empty()) write_file(folder / "log/ranges.csv", bad.ranges);
  if (!bad.odometry.empty()) write_file(folder / "log/odometry.csv", bad.odometry);
  std::vector<std::string> arguments = {"slam", folder / "log", "--out", folder / "out"};
  if (!bad.known.empty())
    arguments.insert(arguments.end(), {"--anchors", folder.file("known.csv", bad.known)});
  const Outcome outcome = mapproof(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
  EXPECT_NE(outcome.error.find(bad.message), std::string::npos) << outcome.error;
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "out"));
}

constexpr const char* kRanges = "t,beacon,range\n0.5,a,1\n1.5,b,2\n";

INSTANTIATE_TEST_SUITE_P(
    Slam, BadSlamInput,
    ::testing::Values(BadSlam{"NoFolder", "", "", "", "log"},
                      BadSlam{"NoRanges", "t,beacon,range\n", "", "", "ranges.csv"},
                      BadSlam{"NanRange", "t,beacon,range\n0,a,nan\n", "", "", "holds no ranges"},
                      BadSlam{"NegativeRange", "t,beacon,range\n0,a,-1\n", "", "", "line 2"},
                      BadSlam{"HugeTime", "t,beacon,range\n1e300,a,1\n", "", "", "line 2"},
                      BadSlam{"BadOdometry", kRanges, "t,ddist,dheading\n1,x,0\n", "", "line 2"},
                      BadSlam{"OdometryBack", kRanges, "t,ddist,dheading\n1,0,0\n0.5,0,0\n", "",
                              "line 3"},
                      BadSlam{"SpeedsAsOdometry", kRanges, "t,v_ms,omega_dps\n1,1,0\n2,1,0\n", "",
                              "\"v_ms\" is a speed or a rate of turning"},
                      BadSlam{"PosesAsOdometry", kRanges, "t,x,y,theta\n1,1,0,0\n2,1,0,0\n", "",
                              "holds poses (x, y)"},
                      BadSlam{"UnknownLandmark", kRanges, "", "name,x,y\nzebra,1,2\n", "zebra"},
                      BadSlam{"NanLandmark", kRanges, "", "name,x,y\na,nan,2\n", "line 2"}),
    [](const auto& one) { return one.param.name; });

/// The bounds on the published data, windows chosen without ground truth, no landmark
/// known.
TEST(SlamOnPlaza, MeetsTheBoundsOfSpectralAndRefinedErrors) {
  const auto plaza = plaza_folder();
  if (!plaza) GTEST_SKIP() << kNoPlaza;
  struct Bound {
    const char* set;
    double spectral_m;
    double refined_m;
  };
  for (const Bound& bound : {Bound{"plaza1", 0.70, 0.21}, Bound{"plaza2", 0.30, 0.19}}) {
    const TemporaryFolder folder;
    const Outcome outcome =
        mapproof({"slam", *plaza / bound.set, "--out", folder / "out", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
    const json result = json::parse(outcome.out);
    for (const auto& [method, most_m] :
         {std::pair("spectral", bound.spectral_m), std::pair("refined", bound.refined_m)}) {
      EXPECT_EQ(method_of(result, method).at("errors").at(0).at("alignment"), "rigid");
      EXPECT_LE(mean_error(result, method), most_m) << bound.set << " " << method;
    }
  }
}

}  // namespace
}  // namespace mapproof::test
