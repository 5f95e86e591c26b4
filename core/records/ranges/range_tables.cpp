#include "core/records/ranges/range_tables.hpp"

#include <cmath>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/tables/cells.hpp"
#include "core/records/tables/number_rows.hpp"

namespace mapproof {
namespace {

constexpr double kLatest_s = 1e12;
constexpr double kMostHeading_rad = 1e6;

void check_bound(const NumberTable& table, Eigen::Index row, Eigen::Index column, double bound,
                 std::string_view what) {
  const double value = table.values(row, column);
  if (!(std::abs(value) <= bound))
    table.fail(row, fmt::format("{} is at most {:g}, got {:g}", what, bound, value));
}

/// Times in the first column.
void check_times(const NumberTable& table, bool must_ascend) {
  if (table.values.rows() > kMostSteps)
    throw IoError(table.source, fmt::format("more than {} rows", kMostSteps));
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    check_bound(table, i, 0, kLatest_s, "a time in seconds");
    if (must_ascend && i > 0 && !(table.values(i, 0) > table.values(i - 1, 0)))
      table.fail(i, fmt::format("the time {} s is not after the one before, {} s",
                                table.values(i, 0), table.values(i - 1, 0)));
  }
}

std::string numbered_name(const NumberTable& table, Eigen::Index row, double number) {
  if (!(std::abs(number) <= 1e9 && number == std::trunc(number)))
    table.fail(row, fmt::format("expected a landmark's number without decimals, got {:g}", number));
  return fmt::format("{}", static_cast<long long>(number));
}

}  // namespace

void NumberTable::set_values(const std::vector<double>& by_row, Eigen::Index width) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  values = Eigen::Map<const RowMajor>(by_row.data(), std::ssize(rows), width);
}

std::string NumberTable::location(Eigen::Index row) const {
  return fmt::format("{} {}", row_word, rows[static_cast<std::size_t>(row)]);
}

void NumberTable::fail(Eigen::Index row, const std::string& what) const {
  throw IoError(source, location(row), what);
}

NumberTable read_number_table(ByteSource& source, std::size_t width) {
  NumberTable table{.source = source.name()};
  const std::string bytes = source.rest();
  NumberRows rows(checked_text(bytes, table.source), table.source, width);
  std::vector<double> values;
  while (rows.next()) {
    table.rows.push_back(rows.line());
    values.insert(values.end(), rows.values().begin(), rows.values().end());
  }
  table.set_values(values, static_cast<Eigen::Index>(width));
  return table;
}

Trajectory trajectory_in(const NumberTable& table) {
  check_times(table, true);
  const bool has_heading = table.values.cols() > 3;
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    check_bound(table, i, 1, kFarthest_m, "a coordinate in metres");
    check_bound(table, i, 2, kFarthest_m, "a coordinate in metres");
    if (has_heading) check_bound(table, i, 3, kMostHeading_rad, "a heading in radians");
  }
  Trajectory path{.time_s = table.values.col(0),
                  .positions_m = table.values.middleCols(1, 2),
                  .heading_rad = {}};
  if (has_heading) path.heading_rad = table.values.col(3);
  return path;
}

std::vector<Motion> motions_in(const NumberTable& table) {
  check_times(table, true);
  const bool has_sideways = table.values.cols() > 3;
  std::vector<Motion> motions;
  motions.reserve(static_cast<std::size_t>(table.values.rows()));
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    check_bound(table, i, 1, kLongestRange_m, "a distance in metres");
    check_bound(table, i, 2, kMostHeading_rad, "a heading change in radians");
    if (has_sideways) check_bound(table, i, 3, kLongestRange_m, "a distance in metres");
    motions.push_back({.time_s = table.values(i, 0),
                       .distance_m = table.values(i, 1),
                       .heading_change_rad = table.values(i, 2),
                       .sideways_m = has_sideways ? table.values(i, 3) : 0.0});
  }
  return motions;
}

std::vector<NamedMeasurement> measurements_in(const NumberTable& table) {
  check_times(table, false);
  std::vector<NamedMeasurement> measurements;
  measurements.reserve(static_cast<std::size_t>(table.values.rows()));
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    const double range_m = table.values(i, 1);
    if (const std::string problem = observation_problem(Sensor::kRange, range_m); !problem.empty())
      table.fail(i, problem);
    measurements.push_back({.time_s = table.values(i, 0),
                            .landmark = table.names[static_cast<std::size_t>(i)],
                            .range_m = range_m});
  }
  return measurements;
}

NamedPoints landmarks_in(const NumberTable& table) {
  NamedPoints landmarks{
      .names = table.names, .positions_m = table.values.leftCols(2), .locations = {}};
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    check_bound(table, i, 0, kFarthest_m, "a coordinate in metres");
    check_bound(table, i, 1, kFarthest_m, "a coordinate in metres");
    landmarks.locations.push_back(table.location(i));
  }
  std::map<std::string_view, Eigen::Index> seen;
  for (Eigen::Index i = 0; i < table.values.rows(); ++i) {
    const std::string& name = table.names[static_cast<std::size_t>(i)];
    const auto [other, is_new] = seen.emplace(name, i);
    if (!is_new)
      table.fail(i, fmt::format("landmark {} is already on {}", in_quotes(name),
                                table.location(other->second)));
  }
  return landmarks;
}

NumberTable selected(const NumberTable& table, const std::vector<Eigen::Index>& columns,
                     Eigen::Index names) {
  NumberTable part = table;
  part.values = table.values(Eigen::all, columns);
  for (Eigen::Index i = 0; i < table.values.rows(); ++i)
    part.names.push_back(numbered_name(table, i, table.values(i, names)));
  return part;
}

void check_one_sender(const NumberTable& table, Eigen::Index column) {
  for (Eigen::Index i = 1; i < table.values.rows(); ++i)
    if (table.values(i, column) != table.values(0, column))
      table.fail(i, fmt::format("a measurement of robot {:g} after those of robot {:g}: give the "
                                "measurements of one robot",
                                table.values(i, column), table.values(0, column)));
}

}  // namespace mapproof
