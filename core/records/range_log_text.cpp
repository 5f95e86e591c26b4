#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/json/text_input.hpp"
#include "core/records/number_rows.hpp"
#include "core/records/range_log_parts.hpp"
#include "core/records/range_log_readers.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

NumberTable read_numbers(const fs::path& path, std::size_t width) {
  NumberTable table{.source = path.string()};
  const std::string bytes = read_file(path);
  NumberRows rows(checked_text(bytes, table.source), table.source, width);
  std::vector<double> values;
  while (rows.next()) {
    table.rows.push_back(rows.line());
    values.insert(values.end(), rows.values().begin(), rows.values().end());
  }
  table.set_values(values, static_cast<Eigen::Index>(width));
  return table;
}

}  // namespace

RangeLog read_range_log_text(const fs::path& stem, const RangeLogOptions& options) {
  const fs::path ranges_path = stem.string() + "_TD.txt";
  const fs::path odometry_path = stem.string() + "_DR.txt";
  RangeLogParts parts{.source = ranges_path.string(), .name = options.name};
  const NumberTable ranges = read_numbers(ranges_path, 4);
  check_one_sender(ranges, 1);
  parts.readings = readings_in(selected(ranges, {0, 3}, 2));
  std::error_code error;
  if (fs::exists(odometry_path, error)) {
    parts.odometry = motions_in(read_numbers(odometry_path, 3));
    parts.remarks.push_back(
        "The odometry is DR as it stands; whether its turns are the robot's own cannot be told "
        "without the truth.");
  }
  return assemble(std::move(parts), options);
}

}  // namespace mapproof
