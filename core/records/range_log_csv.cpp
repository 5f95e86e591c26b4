#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/csv_columns.hpp"
#include "core/records/range_log_parts.hpp"
#include "core/records/range_log_readers.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

const CsvColumn kTime{.label = "times", .words = {"t", "time", "time_s"}};
const CsvColumn kX{.label = "x", .words = {"x", "x_m"}};
const CsvColumn kY{.label = "y", .words = {"y", "y_m"}};
const CsvColumn kHeading{.label = "headings", .words = {"heading", "heading_rad", "theta"}};
const CsvColumn kDistance{.label = "distances", .words = {"ddist", "distance", "distance_m"}};
const CsvColumn kTurn{.label = "turns", .words = {"dheading", "turn", "turn_rad"}};
const CsvColumn kSideways{
    .label = "ways sideways", .words = {"dside", "sideways", "sideways_m"}, .is_needed = false};
const CsvColumn kLandmark{.label = "landmarks",
                          .words = {"beacon", "landmark", "id", "name", "object"}};
const CsvColumn kRange{.label = "ranges", .words = {"range", "range_m"}};
const CsvColumn kRobot{.label = "robots", .words = {"robot", "sender"}, .is_needed = false};

/// Bytes within which a header ends.
constexpr std::size_t kLongestHeader = 65'536;

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

StartPose read_start(const fs::path& path) {
  const NumberTable table = read_columns(path, {kTime, kX, kY, kHeading});
  if (table.values.rows() != 1) throw IoError(path.string(), "expected one row, that of the start");
  const Trajectory pose = trajectory_in(table);
  return {.time_s = pose.time_s(0),
          .x_m = pose.positions_m(0, 0),
          .y_m = pose.positions_m(0, 1),
          .heading_rad = pose.heading_rad(0)};
}

std::vector<Motion> read_motions(const fs::path& path) {
  return motions_in(read_columns(path, {kTime, kDistance, kTurn, kSideways}));
}

/// NAME.csv, and NAME_start.csv if it is there.
void take_odometry(const fs::path& folder, const std::string& name, RangeLogParts& parts) {
  parts.odometry = read_motions(folder / (name + ".csv"));
  const fs::path start = folder / (name + "_start.csv");
  if (is_there(start)) parts.start = read_start(start);
}

Trajectory read_truth(const fs::path& path) {
  CsvColumn heading = kHeading;
  heading.is_needed = false;
  return trajectory_in(read_columns(path, {kTime, kX, kY, heading}));
}

NamedPoints read_true_landmarks(const fs::path& path) {
  return landmarks_in(read_columns(path, {kX, kY}, &kLandmark));
}

}  // namespace

bool has_range_columns(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string start(kLongestHeader, '\0');
  file.read(start.data(), std::ssize(start));
  start.resize(static_cast<std::size_t>(file.gcount()));
  if (start.size() == kLongestHeader) start.resize(start.rfind('\n') + 1);
  try {
    return has_columns(checked_text(start, path.string()), {kTime, kLandmark, kRange});
  } catch (const IoError&) {
    return false;  // No text: whoever reads it says what is wrong.
  }
}

RangeLog read_range_log_csv(const fs::path& folder, const RangeLogOptions& options) {
  RangeLogParts parts{.source = (folder / "ranges.csv").string(), .name = options.name};
  const NumberTable ranges =
      read_columns(folder / "ranges.csv", {kTime, kRange, kRobot}, &kLandmark);
  if (ranges.values.cols() > 2) check_one_sender(ranges, 2);
  parts.readings = readings_in(ranges);
  const bool has_recovered = is_there(folder / "odometry_drp.csv");
  const bool has_given = is_there(folder / "odometry.csv");
  if (has_recovered && (options.odometry == OdometrySource::kRecovered || !has_given)) {
    take_odometry(folder, "odometry_drp", parts);
    parts.remarks.push_back(
        "The odometry is that of odometry_drp.csv, recovered from the dead-reckoned path.");
  } else if (has_given) {
    take_odometry(folder, "odometry", parts);
  }
  if (const fs::path truth = folder / "groundtruth.csv"; is_there(truth))
    parts.truth = read_truth(truth);
  if (const fs::path landmarks = folder / "landmarks.csv"; is_there(landmarks))
    parts.true_landmarks = read_true_landmarks(landmarks);
  return assemble(std::move(parts), options);
}

void take_named_files(const RangeLogOptions& options, RangeLogParts& parts) {
  if (!options.odometry_file.empty()) {
    parts.odometry = read_motions(options.odometry_file);
    parts.start.reset();
  }
  if (!options.truth_file.empty()) parts.truth = read_truth(options.truth_file);
  if (!options.landmarks_file.empty())
    parts.true_landmarks = read_true_landmarks(options.landmarks_file);
}

}  // namespace mapproof
