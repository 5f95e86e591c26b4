#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kSeen =
    "a,0.1,1,2,3\nb,0.2,1.2,2.1,3\nc,-0.3,0.9,2,2.9\nd,0.1,0.2,0.3,0.4\ne,1,2,0,1\n";
constexpr const char* kAnchors = "name,x,y\na,0,0\nb,1,0\nc,0,1\nd,1,1\n";

/// One thing wrong with a call of `map`, and what the message has to contain.
struct BadMap {
  std::string name;
  std::string observations;
  std::string anchors;
  std::vector<std::string> more;
  std::string message;
};

std::ostream& operator<<(std::ostream& out, const BadMap& bad) { return out << bad.name; }

class BadMapInput : public ::testing::TestWithParam<BadMap> {};

TEST_P(BadMapInput, IsOneClearLineWithItsPlaceAndNothingWritten) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments = {
      "map",       folder.file("seen.csv", GetParam().observations), "--sensor", "bearing",
      "--anchors", folder.file("anchors.csv", GetParam().anchors),   "--out",    folder / "map"};
  arguments.insert(arguments.end(), GetParam().more.begin(), GetParam().more.end());
  const Outcome outcome = mapproof(arguments);
  EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
  EXPECT_NE(outcome.error.find(GetParam().message), std::string::npos) << outcome.error;
  // One line on what was understood of the table may stand before the error.
  const std::size_t error_at = outcome.error.find("mapproof: ");
  ASSERT_NE(error_at, std::string::npos) << outcome.error;
  const std::string understood = outcome.error.substr(0, error_at);
  EXPECT_LE(std::ranges::count(understood, '\n'), 1) << outcome.error;
  EXPECT_TRUE(understood.empty() || understood.find(" landmarks x ") != std::string::npos);
  EXPECT_EQ(std::ranges::count(outcome.error, '\n') - std::ranges::count(understood, '\n'), 1)
      << outcome.error;
  EXPECT_LT(outcome.error.size(), 800U);
  EXPECT_TRUE(outcome.out.empty());
  EXPECT_FALSE(fs::exists(folder / "map"));
}

INSTANTIATE_TEST_SUITE_P(
    Map, BadMapInput,
    ::testing::Values(
        BadMap{"RaggedCsv", "a,1,2,3\nb,1,2\nc,1,2,3\n", kAnchors, {}, "seen.csv: line 2"},
        BadMap{"NoNumber", "a,1,2,3\nb,1,x,3\nc,1,2,3\n", kAnchors, {}, "seen.csv: line 2"},
        BadMap{"Infinity", "a,1,2,3\nb,1,inf,3\nc,1,2,3\n", kAnchors, {}, "seen.csv: line 2"},
        BadMap{"Degrees", "a,1,2,3\nb,1,270,3\nc,1,2,3\n", kAnchors, {}, "seen.csv: line 2"},
        BadMap{"Empty", "", kAnchors, {}, "seen.csv"},
        BadMap{"MillionDigits",
               "a,1,2,3\nb,1," + std::string(1000000, '9') + ",3\nc,1,2,3\n",
               kAnchors,
               {},
               "seen.csv: line 2"},
        BadMap{"SameNameTwice", "a,1,2,3\na,1,2,3\nc,1,2,3\n", kAnchors, {}, "seen.csv: line 2"},
        BadMap{"NanAnchor", kSeen, "name,x,y\na,0,0\nb,nan,0\nc,0,1\n", {}, "anchors.csv: line 3"},
        BadMap{"TwoAnchors",
               kSeen,
               "name,x,y\na,0,0\nb,1,0\n",
               {},
               "anchors.csv: 2 observed anchors; an affine map to the anchors needs 3"},
        BadMap{"CollinearAnchors",
               kSeen,
               "a,0,0\nb,1,1\nc,2,2\nd,5,5\n",
               {},
               "anchors.csv: its 4 anchors lie on one line"},
        BadMap{"UnknownAnchor",
               kSeen,
               "name,x,y\na,0,0\nzebra,1,0\nc,0,1\n",
               {},
               "anchors.csv: line 3: anchor \"zebra\" is not among the 5 landmarks"},
        BadMap{"NeverObserved",
               "a,1,2,3\nb,,nan,\nc,1,2,3\nd,1,1,1\n",
               kAnchors,
               {},
               "seen.csv: line 2: landmark \"b\" is never observed"},
        BadMap{"TooManyNeighbours", kSeen, kAnchors, {"-K", "5"}, "K = 5 needs more than 5"},
        BadMap{"HalfANeighbour", kSeen, kAnchors, {"-K", "2.5"}, "-K: K = 2.5"},
        BadMap{"NoNeighbour", kSeen, kAnchors, {"-K", "0"}, "-K: K = 0"},
        BadMap{"NanNeighbours", kSeen, kAnchors, {"--parameter", "nan"}, "--parameter: \"nan\" is not"},
        BadMap{"NeighboursOfAKernel",
               kSeen,
               kAnchors,
               {"--method", "kpca-gaussian", "-K", "5"},
               "-K: the method kpca-gaussian has the parameter σ²; did you mean --sigma2?"},
        BadMap{"NoVariance",
               kSeen,
               kAnchors,
               {"--method", "kpca-gaussian", "--sigma2", "0"},
               "--sigma2: σ² = 0 is not a number from 1e-09 to 1e+12"},
        BadMap{"HalfADegree",
               kSeen,
               kAnchors,
               {"--method", "kpca-polynomial", "--degree", "2.5"},
               "--degree: d = 2.5 is not an integer from 1 to 20"},
        BadMap{"UnknownMethod",
               kSeen,
               kAnchors,
               {"--method", "isomp"},
               "unknown method \"isomp\"; did you mean \"isomap\"?"},
        BadMap{"ParameterOfNone",
               kSeen,
               kAnchors,
               {"--method", "lpca", "-K", "5"},
               "the method lpca has no parameter"},
        BadMap{"MoreStepsThanThereAre",
               kSeen,
               kAnchors,
               {"--steps", "5"},
               "--steps 5: it holds 4 observations"},
        BadMap{"TwoLandmarks", "a,1,2\nb,2,3\n", "a,0,0\n", {}, "a map needs 3 or more"},
        BadMap{"NoSuchGroundTruth",
               kSeen,
               kAnchors,
               {"--truth", "/nonexistent.csv"},
               "/nonexistent.csv: cannot be opened"},
        BadMap{
            "NoSuchTemplates", kSeen, kAnchors, {"--templates", "/nonexistent"}, "/nonexistent"}),
    [](const auto& test) { return test.param.name; });

TEST(BadInput, VisibilityThatIsAllZeroNamesItsLine) {
  const TemporaryFolder folder;
  const Outcome outcome = mapproof({"map", folder.file("seen.csv", "a,1,0,1\nb,1,1,0\nc,0,0,0\n"),
                                    "--sensor", "visibility", "--out", folder / "map"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("seen.csv: line 3: landmark \"c\" is never observed (no 1"),
            std::string::npos)
      << outcome.error;
}

/// One thing wrong with an experiment's file.
struct BadExperiment {
  std::string name;
  std::string from;
  std::string to;
  std::string message;
};

std::ostream& operator<<(std::ostream& out, const BadExperiment& bad) { return out << bad.name; }

class BadExperimentFile : public ::testing::TestWithParam<BadExperiment> {};

TEST_P(BadExperimentFile, IsRefusedWithItsPlace) {
  const TemporaryFolder folder;
  std::string text = read_file(std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json");
  const std::size_t at = text.find(GetParam().from);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, GetParam().from.size(), GetParam().to);
  const Outcome outcome =
      mapproof({"run", folder.file("bad.json", text), "--out", folder / "study"});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
  EXPECT_NE(outcome.error.find("bad.json: "), std::string::npos) << outcome.error;
  EXPECT_NE(outcome.error.find(GetParam().message), std::string::npos) << outcome.error;
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "study"));
}

INSTANTIATE_TEST_SUITE_P(
    Experiment, BadExperimentFile,
    ::testing::Values(BadExperiment{"BillionLayouts", "\"layouts\": 2", "\"layouts\": 1000000000",
                                    "/layouts"},
                      BadExperiment{"MillionDigitSeed", "\"seed\": ",
                                    "\"seed\": " + std::string(1000000, '9') + ", \"x\": ", ""},
                      BadExperiment{"UnknownMethod", "\"isomap\"", "\"isomop\"", "isomap"},
                      BadExperiment{"UnknownKey", "\"layouts\"", "\"layuots\"", "layouts"}),
    [](const auto& test) { return test.param.name; });

TEST(BadInput, ATruncatedExperimentIsRefusedAtEveryLength) {
  const TemporaryFolder folder;
  const std::string text = read_file(std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json");
  for (std::size_t length = 0; length + 3 < text.size(); length += 97) {
    const Outcome outcome = mapproof(
        {"run", folder.file("cut.json", text.substr(0, length)), "--out", folder / "study"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.error.find("cut.json: "), std::string::npos) << outcome.error;
  }
  EXPECT_FALSE(fs::exists(folder / "study"));
}

TEST(BadInput, AnOutputFolderThatCannotBeWrittenIsNamed) {
  const TemporaryFolder folder;
  const std::string in_the_way = folder.file("file", "not a folder");
  const std::string small = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";
  for (const std::string& out : {in_the_way, in_the_way + "/below", std::string("/proc/none")}) {
    const Outcome outcome = mapproof({"run", small, "--out", out});
    EXPECT_EQ(outcome.exit_code, 2) << out << outcome.error;
    EXPECT_NE(outcome.error.find(out.substr(0, 8)), std::string::npos) << outcome.error;
    EXPECT_EQ(mapproof({"map", std::string(MAPPROOF_TEST_DATA) + "/mrclam", "--method", "lpca",
                        "--out", out})
                  .exit_code,
              2);
  }
}

TEST(BadInput, AFullDiskLosesNothingAndLeavesNoPart) {
  const TemporaryFolder folder;
  const std::string small = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";
  const Outcome full = mapproof({"run", small, "--out", folder / "study"}, {.file_bytes = 2000});
  EXPECT_EQ(full.exit_code, 2) << full.error;
  EXPECT_NE(full.error.find("cannot be written"), std::string::npos) << full.error;
  for (const auto& [file, bytes] : contents(folder / "study"))
    EXPECT_EQ(file.find(".part"), std::string::npos) << file;
  EXPECT_EQ(mapproof({"run", small, "--out", folder / "study"}).exit_code, 0);

  ASSERT_EQ(mapproof({"report", folder / "study"}).exit_code, 0);
  const auto before = contents(folder / "study");
  EXPECT_EQ(mapproof({"report", folder / "study"}, {.file_bytes = 2000}).exit_code, 2);
  EXPECT_EQ(contents(folder / "study"), before);
}

TEST(BadInput, ARealSetThatIsBrokenIsRefusedBeforeAnythingIsMade) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "sets");
  std::filesystem::copy(std::string(MAPPROOF_TEST_DATA) + "/mrclam", folder / "sets/whole");
  std::filesystem::copy(std::string(MAPPROOF_TEST_DATA) + "/mrclam", folder / "sets/broken");
  std::filesystem::remove(folder / "sets/broken/Barcodes.dat");
  const Outcome outcome =
      mapproof({"reproduce", "mrclam", "--data", folder / "sets", "--out", folder / "out"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("broken/Barcodes.dat"), std::string::npos) << outcome.error;
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

TEST(BadInput, AFolderThatIsNoStudyIsNamed) {
  const TemporaryFolder folder;
  folder.file("study/study.json", "{}");
  for (const char* command : {"render", "report"}) {
    EXPECT_EQ(mapproof({command, folder / "none"}).exit_code, 2);
    const Outcome outcome = mapproof({command, folder / "study"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.error.find("study.json"), std::string::npos) << outcome.error;
  }
}

}  // namespace
}  // namespace mapproof::test
