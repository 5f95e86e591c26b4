// Inputs of the program by name, by pipe, as standard input, packed and not.
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/observations/observation_json.hpp"
#include "tests/core/range_slam/sample_log.hpp"
#include "tests/support/packing.hpp"
#include "tests/support/program.hpp"
#include "tests/support/samples/detections_csv.hpp"
#include "tests/support/samples/scans.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// Runs a line of bash in a folder, where $MAPPROOF is the program; 124 if it takes too long.
Outcome shell(const fs::path& folder, const std::string& line, double seconds = 60.0) {
  return run_program(
      {"timeout", std::to_string(seconds), "bash", "-c",
       fmt::format("cd '{}' && MAPPROOF='{}' && {}", folder.string(), program(), line)});
}

/// A way to give a file `f` to a command: the text before the command, and the name of the input.
/// `f.gz` and `f.xz` are the same file, packed.
struct Way {
  std::string name;
  std::string before;
  std::string input;
};

const std::vector<Way>& ways() {
  static const std::vector<Way> all = {
      {"Pipe", "", "<(cat f)"},    {"StandardInput", "cat f |", "-"},
      {"Redirected", "", "- < f"}, {"DevStdin", "cat f |", "/dev/stdin"},
      {"Gzip", "", "f.gz"},        {"GzipPipe", "", "<(cat f.gz)"},
      {"Xz", "", "f.xz"},          {"XzStandardInput", "cat f.xz |", "-"}};
  return all;
}

/// A command that reads one input, in the folder of the samples.
struct Reader {
  std::string name;
  std::function<std::string()> bytes;  ///< Of the input.
  std::string arguments;               ///< With {} for the input; outputs go to `out`.
  /// What has to be equal: these files below `out`, or, without any, the printed JSON.
  std::vector<std::string> written = {};
};

[[maybe_unused]] std::ostream& operator<<(std::ostream& out, const Reader& reader) {
  return out << reader.name;
}

const std::vector<std::string> kMap = {"map.json", "map.csv"};
const std::vector<std::string> kSlam = {"slam.json"};

constexpr const char* kAnchors = "name,x,y\na,0,0\nb,1,0\nc,0,1\nd,1,1\n";

std::string anchors() { return kAnchors; }

/// Some 3 MB: 60,000 steps of four landmarks.
std::string long_table() {
  Random random(7);
  std::string text = "step,landmark,value\n";
  for (int step = 0; step < 60'000; ++step)
    for (const char* name : {"a", "b", "c", "d"})
      text += fmt::format("{},{},{}\n", step, name, random.uniform() < 0.4 ? 1 : 0);
  return text;
}

std::string wide_table(int steps) {
  Random random(3);
  std::string text;
  for (int landmark = 0; landmark < 6; ++landmark) {
    text += static_cast<char>('a' + landmark);
    for (int step = 0; step < steps; ++step)
      text += fmt::format(",{:.3f}", random.uniform() * 6.0 - 3.0);
    text += '\n';
  }
  return text;
}

/// Some 2 MB.
std::string wide_table() { return wide_table(50'000); }

std::string seen_table() {
  Random random(5);
  std::string text;
  for (const char* name : {"a", "b", "c", "d", "e", "f"}) {
    text += name;
    for (int step = 0; step < 80; ++step) text += random.uniform() < 0.5 ? ",1" : ",0";
    text += '\n';
  }
  return text;
}

DetectionLog scans() {
  Points locations(9, 2);
  for (Eigen::Index i = 0; i < 9; ++i)
    locations.row(i) << static_cast<double>(i % 3), 0.9 * static_cast<double>(i / 3);
  return scans_at(locations, 300, 5, 3);
}

std::string scans_csv() { return detections_csv(scans()); }

std::string scans_json() { return detections_json(scans()); }

/// The files besides the input of a command: observations, anchors, a log as `set` and, without its
/// odometry, as `bare`; after its first use, `map` with its figures and `slam`.
class Samples {
 public:
  Samples() {
    folder_.file("wide.csv", wide_table(50));
    folder_.file("anchors.csv", kAnchors);
    csv_folder(folder_, sample_log());
    fs::create_directory(folder_ / "bare");
    fs::copy(folder_ / "set/ranges.csv", folder_ / "bare/ranges.csv");
    write_mat(sample_log(), folder_ / "log.mat", true);
  }

  const fs::path& path() const { return folder_.path(); }

  /// The bytes of a file.
  std::string operator[](const std::string& file) const {
    if (file.starts_with("map/") && !fs::exists(folder_ / "map"))
      make("map wide.csv --sensor bearing --anchors anchors.csv --out map");
    if (file.starts_with("slam/") && !fs::exists(folder_ / "slam"))
      make("slam set --name set --out slam");
    return read_file(folder_ / file);
  }

 private:
  void make(const std::string& arguments) const {
    EXPECT_LT(shell(folder_.path(), "$MAPPROOF " + arguments).exit_code, 2);
  }

  TemporaryFolder folder_;
};

const Samples& samples() {
  static const Samples all;
  return all;
}

std::function<std::string()> sample(const std::string& file) {
  return [file] { return samples()[file]; };
}

std::function<std::string()> data(const std::string& file) {
  return [file] { return read_file(std::string(MAPPROOF_TEST_DATA) + "/" + file); };
}

const std::vector<Reader>& readers() {
  static const std::string slam = "slam {} --name log --out out";
  static const std::vector<Reader> all = {
      {"MapOfWideCsv", [] { return wide_table(); },
       "map {} --sensor bearing --method lpca --out out", kMap},
      {"MapOfLongCsv", long_table, "map {} --sensor visibility --method lpca --out out", kMap},
      {"MapOfLongCsvAsSaid", long_table,
       "map {} --sensor visibility --layout long --method lpca --out out", kMap},
      {"MapOfJson", data("observations/observations.json"), "map {} --method lpca --out out", kMap},
      {"MapOfDetections", scans_csv, "map {} --out out", kMap},
      {"MapOfDetectionsJson", scans_json, "map {} --out out", kMap},
      {"MapOfTransposedCsv", data("foreign/pandas_datetime.csv"),
       "map {} --sensor bearing --method lpca --out out", kMap},
      {"MapOfUtf16", data("foreign/pandas_utf16.csv"),
       "map {} --sensor bearing --method lpca --out out", kMap},
      {"MapOfNumpy", data("foreign/numpy.npy"), "map {} --sensor bearing --method lpca --out out",
       kMap},
      {"MapOfNumpyArchive", data("foreign/numpy_columns.npz"),
       "map {} --sensor range --method lpca --out out", kMap},
      {"MapOfJsonLines", data("foreign/pandas_records.jsonl"),
       "map {} --sensor bearing --method lpca --out out", kMap},
      {"MapOfJsonColumns", data("foreign/pandas_columns.json"),
       "map {} --sensor bearing --method lpca --out out", kMap},
      {"MapOfGraph", data("foreign/slam.g2o"), "map {} --sensor range --method lpca --out out",
       kMap},
      {"MapOfOneSensorOfDetections", scans_csv, "map {} --sensor range --method lpca --out out",
       kMap},
      {"Anchors", anchors, "map wide.csv --sensor bearing --anchors {} --out out", kMap},
      {"GroundTruth", anchors, "map wide.csv --sensor bearing --truth {} --out out", kMap},
      {"OtherSensor", seen_table,
       "map wide.csv --sensor bearing --with {} --with-sensor visibility --out out", kMap},
      {"SlamOfMat", sample("log.mat"), slam, kSlam},
      {"SlamOfCsv", sample("set/ranges.csv"), slam + " --odometry set/odometry.csv", kSlam},
      {"SlamOfText", [] { return td_text_of(sample_log()); }, slam + " --odometry set/odometry.csv",
       kSlam},
      {"SlamOfPyfg", [] { return pyfg_of(sample_log()); }, slam, kSlam},
      {"Odometry", sample("set/odometry.csv"), "slam bare --odometry {} --out out", kSlam},
      {"KnownLandmarks", sample("set/landmarks.csv"), "slam set --anchors {} --out out", kSlam},
      {"TruePath", sample("set/groundtruth.csv"), "slam bare --truth {} --out out", kSlam},
      {"TrueLandmarks", sample("set/landmarks.csv"), "slam bare --ground-truth {} --out out",
       kSlam},
      {"DiffOfPng", sample("map/figures/map.png"), "diff map/figures/map.png {} --json"},
      {"DiffOfBaseline", sample("map/figures/map.png"), "diff {} map/figures/map.png --json"},
      {"DiffOfSvg", sample("map/figures/map.svg"), "diff map/figures/map.svg {} --json"},
      {"DiffOfPdf", sample("map/figures/map.pdf"), "diff map/figures/map.pdf {} --json"},
      {"DiffOfFigure", sample("map/figures/map.figure.json"),
       "diff map/figures/map.figure.json {} --json"},
      {"DiffOfMap", sample("map/map.json"), "diff map/map.json {} --json"},
      {"DiffOfSlam", sample("slam/slam.json"), "diff slam/slam.json {} --json"},
      {"ValidateWideCsv", [] { return wide_table(); }, "validate {} --json"},
      {"ValidateLongCsv", long_table, "validate {} --json"},
      {"ValidateDetections", scans_csv, "validate {} --json"},
      {"ValidateAnchors", anchors, "validate {} --json"},
      {"ValidateMat", sample("log.mat"), "validate {} --json"},
      {"ValidateRanges", sample("set/ranges.csv"), "validate {} --json"},
      {"ValidateMap", sample("map/map.json"), "validate {} --json"},
      {"ValidateMapCsv", sample("map/map.csv"), "validate {} --json"},
      {"ValidateExperiment", data("experiments/small.json"), "validate {} --json"},
      {"ValidateTimings", data("study/timings.jsonl"), "validate {} --json"},
      {"ValidateFigure", sample("map/figures/map.figure.json"), "validate {} --json"},
      {"ValidateSvg", sample("map/figures/map.svg"), "validate {} --json"},
      {"ValidatePng", sample("map/figures/map.png"), "validate {} --json"},
      {"ValidatePdf", sample("map/figures/map.pdf"), "validate {} --json"},
      {"ValidateReport", sample("map/report.html"), "validate {} --json"}};
  return all;
}

class InputReader : public ::testing::TestWithParam<std::size_t> {
 protected:
  InputReader() : bytes_(reader().bytes()) {
    for (const auto& entry : fs::directory_iterator(samples().path()))
      fs::create_symlink(entry.path(), folder_ / entry.path().filename().string());
  }
  const Reader& reader() const { return readers()[GetParam()]; }

  Outcome run(const std::string& before, const std::string& input, double seconds = 60.0) const {
    fs::remove_all(folder_ / "out");
    return shell(folder_.path(),
                 fmt::format("{} $MAPPROOF {}", before,
                             fmt::format(fmt::runtime(reader().arguments), input)),
                 seconds);
  }

  /// The part of an outcome that has to be equal.
  std::string result(const Outcome& outcome) const {
    std::string all = fmt::format("exit code {}\n", outcome.exit_code);
    for (const std::string& file : reader().written) all += read_file(folder_ / ("out/" + file));
    if (!reader().written.empty()) return all;
    json said = json::parse(outcome.out);
    for (const char* list : {"files", "items"})
      for (json& item : said[list])
        for (const char* key : {"path", "id", "baseline", "current", "images"}) item.erase(key);
    return all + said["files"].dump(1) + said["items"].dump(1);
  }

  std::string bytes_;
  TemporaryFolder folder_;
};

TEST_P(InputReader, GivesTheSameOfEqualBytesHoweverTheyCome) {
  folder_.file("f", bytes_);
  folder_.file("f.gz", gzipped(bytes_));
  folder_.file("f.xz", xzipped(bytes_));
  const Outcome named = run("", "f");
  EXPECT_LT(named.exit_code, 2) << named.error;
  const std::string expected = result(named);
  for (const Way& way : ways()) {
    const Outcome outcome = run(way.before, way.input);
    EXPECT_EQ(outcome.exit_code, named.exit_code) << way.name << ": " << outcome.error;
    if (outcome.exit_code < 2) {
      EXPECT_TRUE(result(outcome) == expected) << way.name << ": " << outcome.out;
    }
  }
}

TEST_P(InputReader, NeverWaitsForWhatHasNoEnd) {
  ASSERT_EQ(::mkfifo((folder_ / "f").c_str(), 0600), 0);
  for (const std::string& input : {std::string("f"), std::string("/dev/zero"),
                                   std::string("/dev/tty"), std::string("- < /dev/zero")}) {
    const Outcome outcome = run("", input, 5.0);
    const std::string said = outcome.error + outcome.out;
    EXPECT_GT(outcome.exit_code, 0) << input;
    EXPECT_LT(outcome.exit_code, 3) << input << said;
    EXPECT_TRUE(said.find("is a named pipe, a file was expected") != std::string::npos ||
                said.find("is a device, a file was expected") != std::string::npos)
        << input << ": " << said;
    if (!said.starts_with('{')) {
      EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;
    }
    EXPECT_FALSE(fs::exists(folder_ / "out")) << input;
  }
}

TEST_P(InputReader, SaysThatAPackedInputIsCutOff) {
  for (const std::string& packed : {gzipped(bytes_), xzipped(bytes_)}) {
    folder_.file("f", packed.substr(0, packed.size() - 3));
    for (const Way& way : {Way{"Name", "", "f"}, ways().front()}) {
      const Outcome outcome = run(way.before, way.input);
      const std::string said = outcome.error + outcome.out;
      EXPECT_GT(outcome.exit_code, 0) << said;
      EXPECT_LT(outcome.exit_code, 3) << said;
      EXPECT_NE(said.find("'ed file is cut off"), std::string::npos) << said;
      EXPECT_FALSE(fs::exists(folder_ / "out"));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Streams, InputReader, ::testing::Range(std::size_t{0}, readers().size()),
                         [](const auto& test) { return readers()[test.param].name; });

/// Expects a refusal in one line on standard error.
void expect_refused(const Outcome& outcome, const std::string& words) {
  EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
  EXPECT_NE(outcome.error.find(words), std::string::npos) << outcome.error;
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
}

TEST(Streams, AStreamIsNotGivenTwice) {
  const TemporaryFolder folder;
  folder.file("seen.csv", wide_table(50));
  folder.file("anchors.csv", kAnchors);
  for (const char* rest :
       {"map - --sensor bearing --anchors - --out out", "slam - --truth - --out out",
        "map - --sensor bearing --with - --with-sensor range --out out", "validate - -",
        "diff - -"})
    expect_refused(shell(folder.path(), fmt::format("cat seen.csv | $MAPPROOF {}", rest)),
                   "standard input is given twice");
  expect_refused(shell(folder.path(), "cat seen.csv | $MAPPROOF validate - /dev/stdin"),
                 "standard input and /dev/stdin are one stream");
  expect_refused(shell(folder.path(), "$MAPPROOF diff /dev/fd/7 /dev/fd/7 7< <(cat seen.csv)"),
                 "/dev/fd/7 is given twice");
  EXPECT_FALSE(fs::exists(folder / "out"));
  // A file may be: it is opened once more.
  EXPECT_EQ(shell(folder.path(),
                  "$MAPPROOF validate seen.csv seen.csv /dev/stdin /dev/stdin "
                  "< anchors.csv")
                .exit_code,
            0);
  EXPECT_EQ(shell(folder.path(),
                  "$MAPPROOF map <(cat seen.csv) --sensor bearing --anchors "
                  "<(cat anchors.csv) --truth - --out out < anchors.csv")
                .exit_code,
            0);
}

TEST(Streams, AFolderIsNotReadFromStandardInput) {
  const TemporaryFolder folder;
  folder.file("seen.csv", wide_table(50));
  for (const char* rest : {"report -", "render -", "history -", "nightly yairi2007 --store -",
                           "check yairi2007 --baseline -", "approve - out", "approve base -",
                           "map seen.csv --sensor bearing --out -", "run yairi2007 --out -"}) {
    const Outcome outcome = shell(folder.path(), fmt::format("$MAPPROOF {} < seen.csv", rest), 5.0);
    EXPECT_EQ(outcome.exit_code, 2) << rest;
    EXPECT_NE(outcome.error.find("standard input is not a folder"), std::string::npos)
        << rest << ": " << outcome.error;
  }
  expect_refused(shell(folder.path(), "cat seen.csv | $MAPPROOF diff - ."),
                 "they cannot be compared");
}

/// Expects that each command is refused with `words`, which name the file and what it is.
void expect_named(const TemporaryFolder& folder, const std::string& words,
                  std::initializer_list<const char*> commands) {
  for (const char* command : commands) {
    const Outcome outcome = shell(folder.path(), fmt::format("$MAPPROOF {}", command), 5.0);
    EXPECT_GT(outcome.exit_code, 0);
    EXPECT_LT(outcome.exit_code, 3) << command;
    EXPECT_NE((outcome.error + outcome.out).find(words), std::string::npos)
        << outcome.error << outcome.out;
  }
}

TEST(Streams, PipesAndDevicesWithinFoldersAreNamedAtOnce) {
  const std::string data = std::string(MAPPROOF_TEST_DATA);
  for (const char* name : {"Barcodes.dat", "Robot1_Measurement.dat", "Landmark_Groundtruth.dat"}) {
    const TemporaryFolder folder;
    fs::copy(data + "/mrclam", folder / "set");
    fs::remove(folder / "set" / name);
    ASSERT_EQ(::mkfifo((folder / "set" / name).c_str(), 0600), 0);
    expect_named(folder, std::string(name) + ": is a named pipe",
                 {"map set --out out", "validate set", "map set --sensor range-bearing --out out"});
  }
  for (const char* name : {"ranges.csv", "odometry.csv", "groundtruth.csv", "landmarks.csv"}) {
    const TemporaryFolder folder;
    csv_folder(folder, sample_log());
    fs::remove(folder / "set" / name);
    fs::create_symlink("/dev/zero", folder / "set" / name);
    expect_named(folder, std::string(name) + ": is a device",
                 {"slam set --out out", "slam set/ranges.csv --out out", "validate set"});
  }
}

TEST(Streams, APipeInPlaceOfAFileOfAStudyOrAMapIsNamedAtOnce) {
  for (const char* name : {"study.json", "results.csv", "timings.jsonl"}) {
    const TemporaryFolder folder;
    folder.file("set/study.json", R"({"schema": {"name": "mapproof.results_study", "version": 1},
      "title": "T"})");
    folder.file("set/results.csv", "setup,method,quantity,value\ns,m,mpe_m,0.5\n");
    fs::remove(folder / "set" / name);
    ASSERT_EQ(::mkfifo((folder / "set" / name).c_str(), 0600), 0);
    expect_named(folder, std::string("set/") + name + ": is a named pipe, a file was expected",
                 {"validate set"});
    if (name != std::string("timings.jsonl"))
      expect_named(folder, std::string(name) + ": is a named pipe", {"report set"});
  }
  for (const char* name : {"map.json", "slam.json"}) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "set");
    ASSERT_EQ(::mkfifo((folder / "set" / name).c_str(), 0600), 0);
    expect_named(folder, std::string("set/") + name + ": is a named pipe, a file was expected",
                 {"validate set"});
  }
}

TEST(Streams, APipeInPlaceOfAHistoryIsNamedAtOnce) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "history.sqlite").c_str(), 0600), 0);
  for (const char* rest : {"history .", "nightly yairi2007 --profile quick --store ."})
    expect_refused(shell(folder.path(), fmt::format("$MAPPROOF {}", rest), 5.0),
                   "history.sqlite: is a named pipe, a file was expected");
}

TEST(Streams, APipeThatNobodyWritesToCanBeStopped) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo((folder / "f").c_str(), 0600), 0);
  const Outcome outcome =
      shell(folder.path(),
            "timeout -s INT 3 $MAPPROOF map f --incremental --sensor visibility --out out", 10.0);
  EXPECT_NE(outcome.error.find("f: holds no observations"), std::string::npos) << outcome.error;
}

TEST(Streams, ADiffOfPipesShowsBothOnItsPage) {
  const TemporaryFolder folder;
  folder.file("a.png", samples()["map/figures/map.png"]);
  ASSERT_EQ(shell(samples().path(),
                  fmt::format("$MAPPROOF map wide.csv --sensor bearing --method lpca --out {}",
                              (folder / "other").string()))
                .exit_code,
            0);
  const Outcome outcome = shell(folder.path(),
                                "cat a.png | $MAPPROOF diff - <(cat other/figures/map.png) "
                                "--page diff.html");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
  const std::string page = read_file(folder / "diff.html");
  const std::string both = page.substr(page.find("data:image/png") + 1);
  EXPECT_NE(both.find("data:image/png"), std::string::npos);
}

TEST(Streams, AnExperimentMayComeByAPipe) {
  const TemporaryFolder folder;
  fs::copy(std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json", folder / "e.json");
  EXPECT_EQ(shell(folder.path(), "$MAPPROOF run e.json --out a").exit_code, 0);
  EXPECT_EQ(shell(folder.path(), "gzip < e.json | $MAPPROOF run - --out b").exit_code, 0);
  EXPECT_EQ(contents(folder / "a/runs"), contents(folder / "b/runs"));
}

}  // namespace
}  // namespace mapproof::test
