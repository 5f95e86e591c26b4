#include <filesystem>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/records/observations/csv_columns.hpp"
#include "core/records/ranges/range_log_parts.hpp"
#include "core/records/ranges/range_log_readers.hpp"

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

/// The file of that name in a folder, packed or not; empty if there is none.
fs::path file_in(const fs::path& folder, const std::string& name) {
  const fs::path path = plain_or_packed(folder / name);
  std::error_code error;
  return fs::exists(path, error) ? path : fs::path();
}

NumberTable read_table(const fs::path& path, const std::vector<CsvColumn>& numbers,
                       const CsvColumn* names = nullptr) {
  ByteSource source(path);
  return read_columns(source, numbers, names);
}

StartPose read_start(const fs::path& path) {
  const NumberTable table = read_table(path, {kTime, kX, kY, kHeading});
  if (table.values.rows() != 1) throw IoError(table.source, "expected one row, that of the start");
  const Trajectory pose = trajectory_in(table);
  return {.time_s = pose.time_s(0),
          .x_m = pose.positions_m(0, 0),
          .y_m = pose.positions_m(0, 1),
          .heading_rad = pose.heading_rad(0)};
}

std::vector<Motion> read_motions(const fs::path& path) {
  return motions_in(read_table(path, {kTime, kDistance, kTurn, kSideways}));
}

Trajectory read_truth(const fs::path& path) {
  CsvColumn heading = kHeading;
  heading.is_needed = false;
  return trajectory_in(read_table(path, {kTime, kX, kY, heading}));
}

NamedPoints read_true_landmarks(const fs::path& path) {
  return landmarks_in(read_table(path, {kX, kY}, &kLandmark));
}

/// What stands beside ranges.csv.
void take_folder(const fs::path& folder, OdometrySource wanted, RangeLogParts& parts) {
  const fs::path recovered = file_in(folder, "odometry_drp.csv");
  const fs::path given = file_in(folder, "odometry.csv");
  const bool takes_recovered =
      !recovered.empty() && (wanted == OdometrySource::kRecovered || given.empty());
  if (takes_recovered)
    parts.remarks.push_back(
        "The odometry is that of odometry_drp.csv, recovered from the dead-reckoned path.");
  if (const fs::path& odometry = takes_recovered ? recovered : given; !odometry.empty())
    parts.odometry = read_motions(odometry);
  const std::string start_name = takes_recovered ? "odometry_drp_start.csv" : "odometry_start.csv";
  if (const fs::path start = file_in(folder, start_name);
      !start.empty() && (takes_recovered || !given.empty()))
    parts.start = read_start(start);
  if (const fs::path truth = file_in(folder, "groundtruth.csv"); !truth.empty())
    parts.truth = read_truth(truth);
  if (const fs::path landmarks = file_in(folder, "landmarks.csv"); !landmarks.empty())
    parts.true_landmarks = read_true_landmarks(landmarks);
}

}  // namespace

bool names_range_columns(const TableRow& row) {
  return names_columns(row, {kTime, kLandmark, kRange});
}

RangeLog read_range_log_csv(ByteSource& source, const RangeLogOptions& options) {
  RangeLogParts parts{.source = source.name(), .name = options.name};
  const NumberTable ranges = read_columns(source, {kTime, kRange, kRobot}, &kLandmark);
  if (ranges.values.cols() > 2) check_one_sender(ranges, 2);
  parts.readings = readings_in(ranges);
  if (unpacked_name(source.path()).filename() == "ranges.csv")
    take_folder(source.path().parent_path(), options.odometry, parts);
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
