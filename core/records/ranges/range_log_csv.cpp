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
#include "core/records/ranges/range_companions.hpp"
#include "core/records/ranges/range_log_assembly.hpp"
#include "core/records/ranges/range_tables.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

const RangeColumn kTime{ColumnRole::kTime, "times", {}};
const RangeColumn kRange{ColumnRole::kRange, "ranges", {}};
const RangeColumn kRobot{ColumnRole::kRobot, "robots", {"sender"}, false};

/// The file of that name in a folder, packed or not; empty if there is none.
fs::path file_in(const fs::path& folder, const std::string& name) {
  const fs::path path = plain_or_packed(folder / name);
  std::error_code error;
  return fs::exists(path, error) ? path : fs::path();
}

/// The files next to ranges.csv.
void take_folder(const fs::path& folder, const RangeLogOptions& options, RangeLogParts& parts) {
  ColumnNames& names = parts.columns;
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
  if (const fs::path path = file_in(folder, "groundtruth.csv"); !path.empty()) {
    ByteSource source(path);
    parts.ground_truth = read_true_path(source, pose_times(parts), names);
  }
  if (const fs::path path = file_in(folder, "landmarks.csv"); !path.empty()) {
    ByteSource source(path);
    parts.true_landmarks = read_true_landmarks(source, names);
  }
}

}  // namespace

RangeLog read_range_log_csv(ByteSource& source, const RangeLogOptions& options) {
  const fs::path path = source.path();
  RangeLogParts parts{.source = source.name(), .name = options.name, .columns = options.columns};
  mark_columns(source, parts.columns);
  parts.header = first_row(source);
  const NumberTable ranges =
      read_range_columns(source, {kTime, kRange, kRobot}, true, options.columns);
  if (ranges.values.cols() > 2) check_one_sender(ranges, 2);
  if (ranges.left_out > 0)
    parts.remarks.push_back(
        fmt::format("{} without a range: left out.", counted(ranges.left_out, "row")));
  parts.measurements = measurements_in(ranges);
  parts.read = ranges.columns;
  parts.separator = ranges.separator;
  if (unpacked_name(path).filename() == "ranges.csv")
    take_folder(path.parent_path(), options, parts);
  return assemble(std::move(parts), options);
}

}  // namespace mapproof
