// The files of other programs in tests/data/foreign hold the observations that they were made from.
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "app/table_options.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/observations/observations.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kForeign = fs::path(MAPPROOF_SOURCE_DIR) / "tests/data/foreign";

struct ForeignFile {
  fs::path path;
  std::string ground_truth;
  std::vector<std::string> options;
  int attempts = 0;
  bool is_made_by_tool = false;
};

std::vector<ForeignFile> foreign_files() {
  std::vector<ForeignFile> files;
  for (const json& one : json::parse(read_file(kForeign / "files.json")))
    files.push_back({kForeign / one.at("file").get<std::string>(), one.at("ground_truth"),
                     one.at("options"), one.at("attempts"), !one.contains("source")});
  return files;
}

/// The format that the options of the program state.
TableFormat format_of(const std::vector<std::string>& words, std::string& sensor) {
  CLI::App app;
  TableOptions options;
  add_table_options(app, options);
  app.add_option("--sensor", sensor);
  app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  return options.format();
}

/// A value by its scan's rank and its landmark's name.
using Values = std::map<std::pair<int, std::string>, double>;

Values values_of(const DetectionLog& log, double Detection::*value) {
  Values values;
  for (const Detection& seen : log.detections)
    if (!std::isnan(seen.*value))
      values[{seen.step, log.names[static_cast<std::size_t>(seen.landmark)]}] = seen.*value;
  return values;
}

/// Landmarks without names are numbered in the order of the rows.
Values values_of(const ObservationHistory& history, bool has_names) {
  Values values;
  for (Eigen::Index i = 0; i < history.landmarks(); ++i)
    for (Eigen::Index j = 0; j < history.steps(); ++j)
      if (!std::isnan(history.values(i, j)))
        values[{static_cast<int>(j), has_names ? history.names[static_cast<std::size_t>(i)]
                                               : std::to_string(i)}] = history.values(i, j);
  return values;
}

void expect_near(const Values& values, const Values& ground_truth, double tolerance) {
  ASSERT_EQ(values.size(), ground_truth.size());
  for (const auto& [key, value] : ground_truth) {
    ASSERT_TRUE(values.contains(key)) << key.first << ' ' << key.second;
    EXPECT_NEAR(values.at(key), value, tolerance) << key.first << ' ' << key.second;
  }
}

void expect_ground_truth(const ForeignFile& file) {
  std::string sensor;
  const TableFormat format = format_of(file.options, sensor);
  if (file.ground_truth == "refused") {
    try {
      read_observations(file.path, Sensor::kBearing, format);
      ADD_FAILURE() << "was read";
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what()).find("not read: "), std::string::npos) << error.what();
    }
  } else if (file.ground_truth == "bearings" || file.ground_truth == "unnamed") {
    const bool has_names = file.ground_truth == "bearings";
    const auto ground_truth =
        read_observations(kForeign / "ground_truth_bearings.csv", Sensor::kBearing);
    const auto read = read_observations(file.path, Sensor::kBearing, format);
    expect_near(values_of(read.history, has_names), values_of(ground_truth.history, has_names),
                1e-6);
  } else {
    // Positions of markers are measured in images: a side of some 50 pixels, to 2 pixels, gives
    // ranges of up to 2.8 m to 4 %.
    const bool is_measured = file.ground_truth.starts_with("marker");
    const DetectionSource ground_truth = read_detections(
        kForeign / (is_measured ? "ground_truth_markers.csv" : "ground_truth_detections.csv"));
    const DetectionSource read = read_detections(file.path, format);
    const double tolerance = is_measured ? 0.05 : 1e-5;
    expect_near(values_of(read.log, &Detection::bearing_rad),
                values_of(ground_truth.log, &Detection::bearing_rad), tolerance);
    if (file.ground_truth != "marker_bearings")
      expect_near(values_of(read.log, &Detection::range_m),
                  values_of(ground_truth.log, &Detection::range_m), is_measured ? 0.11 : tolerance);
  }
}

TEST(ForeignFiles, HoldTheObservationsThatTheyWereMadeFrom) {
  for (const ForeignFile& file : foreign_files()) {
    SCOPED_TRACE(file.path.filename());
    expect_ground_truth(file);
  }
}

TEST(ForeignFiles, AreFortyAndMostlyReadAtTheFirstAttempt) {
  int tools = 0, first = 0;
  for (const ForeignFile& file : foreign_files()) {
    tools += file.is_made_by_tool ? 1 : 0;
    first += file.attempts == 1 ? 1 : 0;
    // A first attempt states the sensor, and no more than which columns are meant.
    if (file.attempts > 1) continue;
    for (const std::string& option : file.options) EXPECT_NE(option, "--layout") << file.path;
  }
  EXPECT_GE(foreign_files().size(), 40U);
  EXPECT_GE(tools, 24);
  EXPECT_GE(first, 36);
}

TEST(ForeignFiles, AreFineForValidateIfTheyAreForMap) {
  std::vector<std::string> words = {"validate", "--json"};
  for (const ForeignFile& file : foreign_files())
    if (file.ground_truth != "refused" && file.attempts == 1) words.push_back(file.path.string());
  const Outcome outcome = mapproof(words);
  EXPECT_EQ(outcome.exit_code, 0);
  const json result = json::parse(outcome.out);
  for (const json& file : result.at("files"))
    EXPECT_EQ(file.at("problem"), "") << file.at("path");
}

}  // namespace
}  // namespace mapproof::test
