#include "core/records/ranges/range_log_forms.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/ranges/range_log_assembly.hpp"
#include "core/records/ranges/range_log_g2o.hpp"
#include "core/records/ranges/range_tables.hpp"
#include "core/records/tables/table_reader.hpp"
#include "core/records/tables/table_stream.hpp"
#include "core/records/tables/time_text.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTimes = "times";

/// A column that a table names in its header.
struct CsvColumn {
  std::string_view label;               ///< For errors.
  std::vector<std::string_view> words;  ///< What the header may call it, in lower case.
  bool is_needed = true;
};

bool is_called(const CsvColumn& column, std::string_view cell) {
  return std::ranges::find(column.words, lower_case(cell)) != column.words.end();
}

/// Which cell of the rows holds the column.
/// @throws IoError if it is needed but not there, or there twice.
std::optional<std::size_t> cell_of(const CsvColumn& column, const TableRow& header,
                                   const std::string& source) {
  std::optional<std::size_t> found;
  const std::string location = fmt::format("line {}", header.line);
  for (std::size_t i = 0; i < header.cells.size(); ++i) {
    if (!is_called(column, header.cells[i])) continue;
    if (found) throw IoError(source, location, fmt::format("two columns of {}", column.label));
    found = i;
  }
  if (!found && column.is_needed)
    throw IoError(source, location,
                  fmt::format("no column of {}: expected {} in the header", column.label,
                              fmt::join(column.words, ", ")));
  return found;
}

/// @param is_time  A date does as well.
double number_at(const TableRow& row, std::size_t cell, bool is_time, const std::string& source) {
  const std::optional<double> value =
      is_time ? time_in(row.cells[cell]) : number_in(row.cells[cell]);
  if (!value || !std::isfinite(*value))
    throw IoError(source, fmt::format("line {}", row.line),
                  is_time ? time_problem(row.cells[cell]) : number_problem(row.cells[cell]));
  return *value;
}

std::string name_at(const TableRow& row, std::size_t cell, const std::string& source) {
  const std::string_view name = row.cells[cell];
  if (name.empty() || name.size() > kLongestName)
    throw IoError(source, fmt::format("line {}", row.line),
                  name.empty() ? "a landmark without a name" : "a name that is too long");
  return std::string(name);
}

/// The columns of a CSV table in the order asked for, whatever their order there; others are
/// passed over, and so are those that are neither needed nor there.
///
/// @param names  A column of landmarks' names to read as well; nullptr: none.
/// @throws IoError naming the line if there is no such header, a needed column is not there or
///         twice, or a cell of one is not a finite number or an empty name.
NumberTable read_columns(ByteSource& input, const std::vector<CsvColumn>& numbers,
                         const CsvColumn* names = nullptr) {
  const std::string& source = input.name();
  const std::string bytes = input.rest();
  TableReader reader(checked_text(bytes, source), source);
  TableRow row;
  if (!reader.next(row)) throw IoError(source, "is empty");
  const std::size_t width = row.cells.size();
  // Times come first, and are always there.
  std::vector<std::size_t> cells;
  for (const CsvColumn& column : numbers)
    if (const auto cell = cell_of(column, row, source)) cells.push_back(*cell);
  const auto name_cell = names == nullptr ? std::nullopt : cell_of(*names, row, source);

  NumberTable table{.source = source};
  std::vector<double> values;
  while (reader.next(row)) {
    if (row.cells.size() != width)
      throw IoError(source, fmt::format("line {}", row.line),
                    fmt::format("has {} cells, expected {}", row.cells.size(), width));
    if (table.rows.size() == kMostSteps)
      throw IoError(source, fmt::format("more than {} rows", kMostSteps));
    table.rows.push_back(row.line);
    for (std::size_t i = 0; i < cells.size(); ++i)
      values.push_back(number_at(row, cells[i], numbers[i].label == kTimes, source));
    if (name_cell) table.names.push_back(name_at(row, *name_cell, source));
  }
  table.set_values(values, std::ssize(cells));
  if (numbers[0].label == kTimes && table.values.rows() > 0) {
    const Eigen::VectorXd times = table.values.col(0);
    table.values.col(0) *=
        time_scale({times.data(), static_cast<std::size_t>(times.size())}).seconds;
  }
  return table;
}

/// Whether a table's first row names all the columns that are needed.
bool names_columns(const TableRow& row, const std::vector<CsvColumn>& columns) {
  return std::ranges::all_of(columns, [&](const CsvColumn& column) {
    return !column.is_needed ||
           std::ranges::any_of(row.cells, [&](auto cell) { return is_called(column, cell); });
  });
}

const CsvColumn kTime{.label = kTimes,
                      .words = {"t", "time", "time_s", "timestamp", "stamp", "datetime"}};
const CsvColumn kX{.label = "x", .words = {"x", "x_m"}};
const CsvColumn kY{.label = "y", .words = {"y", "y_m"}};
const CsvColumn kHeading{.label = "headings", .words = {"heading", "heading_rad", "theta"}};
const CsvColumn kDistance{.label = "distances", .words = {"ddist", "distance", "distance_m"}};
const CsvColumn kHeadingChange{.label = "heading changes",
                               .words = {"dheading", "turn", "turn_rad"}};
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
  return motions_in(read_table(path, {kTime, kDistance, kHeadingChange, kSideways}));
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
Trajectory read_ground_truth(const fs::path& path, const Eigen::VectorXd& times_s) {
  ByteSource source(path);
  if (is_path_text(source)) return read_path_text(source, times_s);
  if (is_graph(source)) return read_g2o_path(source);
  CsvColumn heading = kHeading;
  heading.is_needed = false;
  return trajectory_in(read_columns(source, {kTime, kX, kY, heading}));
}

NamedPoints read_true_landmarks(const fs::path& path) {
  ByteSource source(path);
  if (is_graph(source)) return read_g2o_landmarks(source);
  return landmarks_in(read_columns(source, {kX, kY}, &kLandmark));
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
  if (const fs::path ground_truth = file_in(folder, "groundtruth.csv"); !ground_truth.empty())
    parts.ground_truth = read_ground_truth(ground_truth, pose_times(parts));
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
  parts.measurements = measurements_in(ranges);
  if (unpacked_name(source.path()).filename() == "ranges.csv")
    take_folder(source.path().parent_path(), options.odometry, parts);
  return assemble(std::move(parts), options);
}

void take_named_files(const RangeLogOptions& options, RangeLogParts& parts) {
  if (!options.odometry_file.empty()) {
    parts.odometry = read_motions(options.odometry_file);
    parts.start.reset();
  }
  if (!options.ground_truth_file.empty())
    parts.ground_truth = read_ground_truth(options.ground_truth_file, pose_times(parts));
  if (!options.landmarks_file.empty())
    parts.true_landmarks = read_true_landmarks(options.landmarks_file);
}

}  // namespace mapproof
