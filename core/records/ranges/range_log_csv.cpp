#include "core/records/ranges/range_log_forms.hpp"

#include <filesystem>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/text/words.hpp"
#include "core/records/ranges/range_columns.hpp"
#include "core/records/ranges/range_log_assembly.hpp"
#include "core/records/ranges/range_log_g2o.hpp"
#include "core/records/ranges/range_tables.hpp"
#include "core/records/tables/respelling.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

const RangeColumn kTime{ColumnRole::kTime, "times", {}};
const RangeColumn kRange{ColumnRole::kRange, "ranges", {}};
const RangeColumn kRobot{ColumnRole::kRobot, "robots", {"sender"}, false};
const RangeColumn kX{ColumnRole::kX, "x", {}};
const RangeColumn kY{ColumnRole::kY, "y", {}};
const RangeColumn kHeading{
    ColumnRole::kHeading, "headings", {"heading", "theta", "yaw", "richtung", "kurs"}};
const RangeColumn kDistance{
    ColumnRole::kDistance, "distances", {"ddist", "distance", "weg", "strecke"}};
const RangeColumn kHeadingChange{ColumnRole::kHeadingChange,
                                 "heading changes",
                                 {"dheading", "turn", "headingchange", "drehung"}};
const RangeColumn kSideways{ColumnRole::kSideways, "ways sideways", {"dside", "sideways"}, false};

/// The file of that name in a folder, packed or not; empty if there is none.
fs::path file_in(const fs::path& folder, const std::string& name) {
  const fs::path path = plain_or_packed(folder / name);
  std::error_code error;
  return fs::exists(path, error) ? path : fs::path();
}

/// An unread table in any form, see respell(). @throws IoError.
ByteSource table_source(const fs::path& path) {
  ByteSource source(path);
  respell(source);
  return source;
}

StartPose read_start(const fs::path& path, const ColumnNames& names) {
  ByteSource source = table_source(path);
  const NumberTable table = read_range_columns(source, {kTime, kX, kY, kHeading}, false, names);
  if (table.values.rows() != 1) throw IoError(table.source, "expected one row, that of the start");
  const Trajectory pose = trajectory_in(table);
  return {.time_s = pose.time_s(0),
          .x_m = pose.positions_m(0, 0),
          .y_m = pose.positions_m(0, 1),
          .heading_rad = pose.heading_rad(0)};
}

std::vector<Motion> read_motions(const fs::path& path, const ColumnNames& names) {
  ByteSource source = table_source(path);
  return motions_in(
      read_range_columns(source, {kTime, kDistance, kHeadingChange, kSideways}, false, names));
}

/// Whether the rows are records of a pose graph, as of g2o.
bool is_graph(ByteSource& source) {
  try {
    return first_row_is(source, names_graph_record, TableReader::kBlanks);
  } catch (const IoError&) {  // The reader of CSV reports what is wrong.
    return false;
  }
}

/// @param times_s  Of the poses of the odometry, for a path without times.
Trajectory read_ground_truth(const fs::path& path, const Eigen::VectorXd& times_s,
                             const ColumnNames& names) {
  ByteSource source(path);
  if (is_path_text(source)) return read_path_text(source, times_s);
  if (is_graph(source)) return read_g2o_path(source);
  RangeColumn heading = kHeading;
  heading.is_needed = false;
  respell(source);
  return trajectory_in(read_range_columns(source, {kTime, kX, kY, heading}, false, names));
}

NamedPoints read_true_landmarks(const fs::path& path, const ColumnNames& names) {
  ByteSource source(path);
  if (is_graph(source)) return read_g2o_landmarks(source);
  respell(source);
  return landmarks_in(read_range_columns(source, {kX, kY}, true, names));
}

/// Of the poses of the odometry: its start, then the end of each motion.
Eigen::VectorXd pose_times(const RangeLogParts& parts) {
  if (parts.odometry.empty()) return {};
  Eigen::VectorXd times_s(std::ssize(parts.odometry) + 1);
  for (Eigen::Index i = 0; i + 1 < times_s.size(); ++i)
    times_s(i + 1) = parts.odometry[static_cast<std::size_t>(i)].time_s;
  times_s(0) = parts.start          ? parts.start->time_s
               : times_s.size() > 2 ? 2.0 * times_s(1) - times_s(2)
                                    : times_s(1) - 1.0;
  return times_s;
}

/// The files next to ranges.csv.
void take_folder(const fs::path& folder, const RangeLogOptions& options, RangeLogParts& parts) {
  const ColumnNames& names = options.columns;
  const fs::path recovered = file_in(folder, "odometry_drp.csv");
  const fs::path given = file_in(folder, "odometry.csv");
  const bool takes_recovered =
      !recovered.empty() && (options.odometry == OdometrySource::kRecovered || given.empty());
  if (takes_recovered)
    parts.remarks.push_back(
        "The odometry is that of odometry_drp.csv, recovered from the dead-reckoned path.");
  if (const fs::path& odometry = takes_recovered ? recovered : given; !odometry.empty())
    parts.odometry = read_motions(odometry, names);
  const std::string start_name = takes_recovered ? "odometry_drp_start.csv" : "odometry_start.csv";
  if (const fs::path start = file_in(folder, start_name);
      !start.empty() && (takes_recovered || !given.empty()))
    parts.start = read_start(start, names);
  if (const fs::path ground_truth = file_in(folder, "groundtruth.csv"); !ground_truth.empty())
    parts.ground_truth = read_ground_truth(ground_truth, pose_times(parts), names);
  if (const fs::path landmarks = file_in(folder, "landmarks.csv"); !landmarks.empty())
    parts.true_landmarks = read_true_landmarks(landmarks, names);
}

/// Whether a header names all the columns that are needed, and no landmarks.
bool names_columns(ByteSource& source, const std::vector<RangeColumn>& columns) {
  return first_row_is(source, [&](const TableRow& row) {
    return missing_columns(row, columns).empty() &&
           missing_columns(row, {RangeColumn{ColumnRole::kLandmark, "", {}}}).size() == 1;
  });
}

/// Refuses landmarks and ranges that the user names and the table of ranges does not have. Other
/// columns may be those of the tables beside it.
void require_named_columns(ByteSource& source, const ColumnNames& names) {
  for (const NamedColumn& column : names) {
    if (column.role != ColumnRole::kLandmark && column.role != ColumnRole::kRange) continue;
    const bool is_there = first_row_is(source, [&](const TableRow& header) {
      for (std::size_t i = 0; i < header.cells.size(); ++i)
        if (is_named(column, header.cells[i], i)) return true;
      return false;
    });
    if (!is_there)
      throw IoError(source.name(), fmt::format("no column {}, which --columns names for {}",
                                               in_quotes(column.header), name(column.role)));
  }
}

}  // namespace

std::string check_range_companion(ByteSource& source) {
  const std::vector<RangeColumn> motions = {kTime, kDistance, kHeadingChange, kSideways};
  std::vector<RangeColumn> poses = {kTime, kX, kY, kHeading};
  poses.back().is_needed = false;
  std::string form;
  try {
    form = path_form(source);
    if (form.empty() && names_columns(source, motions)) form = "odometry";
    if (form.empty() && names_columns(source, poses)) form = "CSV";
  } catch (const IoError&) {  // No text: other readers report what is wrong.
  }
  if (form.empty()) return "";
  if (form == "odometry") {
    motions_in(read_range_columns(source, motions, false, {}));
    return "odometry of a range log, CSV";
  }
  if (form == "TUM")
    read_path_text(source, {});
  else if (form == "KITTI")
    read_number_table(source, 12);
  else
    trajectory_in(read_range_columns(source, poses, false, {}));
  return "path, " + form;
}

RangeLog read_range_log_csv(ByteSource& source, const RangeLogOptions& options) {
  const fs::path path = source.path();
  RangeLogParts parts{.source = source.name(), .name = options.name};
  respell(source);
  require_named_columns(source, options.columns);
  const NumberTable ranges =
      read_range_columns(source, {kTime, kRange, kRobot}, true, options.columns);
  if (ranges.values.cols() > 2) check_one_sender(ranges, 2);
  if (ranges.left_out > 0)
    parts.remarks.push_back(
        fmt::format("{} without a range: left out.", counted(ranges.left_out, "row")));
  parts.measurements = measurements_in(ranges);
  if (unpacked_name(path).filename() == "ranges.csv")
    take_folder(path.parent_path(), options, parts);
  return assemble(std::move(parts), options);
}

void take_named_files(const RangeLogOptions& options, RangeLogParts& parts) {
  if (!options.odometry_file.empty()) {
    parts.odometry = read_motions(options.odometry_file, options.columns);
    parts.start.reset();
  }
  if (!options.ground_truth_file.empty())
    parts.ground_truth =
        read_ground_truth(options.ground_truth_file, pose_times(parts), options.columns);
  if (!options.landmarks_file.empty())
    parts.true_landmarks = read_true_landmarks(options.landmarks_file, options.columns);
}

}  // namespace mapproof
