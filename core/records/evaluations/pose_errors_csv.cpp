#include "core/records/evaluations/pose_errors_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/csv.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {
namespace {

/// In the order in which they are written.
constexpr std::array<std::string_view, 11> kColumns = {
    "time_s",   "pose",     "distance_m", "x_m",     "y_m",      "z_m",
    "true_x_m", "true_y_m", "true_z_m",   "error_m", "error_deg"};
enum Column : std::size_t {
  kTime,
  kPose,
  kDistance,
  kX,
  kY,
  kZ,
  kTrueX,
  kTrueY,
  kTrueZ,
  kError,
  kAngle
};

class ErrorsReader {
 public:
  ErrorsReader(std::string_view text, const std::string& source)
      : source_(source), reader_(text, source, ',') {}

  PoseErrors read() {
    if (!reader_.next(row_)) throw IoError(source_, "has no header");
    read_header();
    while (reader_.next(row_))
      if (has_alone({kTrueX, kTrueY, kTrueZ}))
        read_alone({kTrueX, kTrueY, kTrueZ}, ground_truth_alone_);
      else if (has_alone({kX, kY, kZ}))
        read_alone({kX, kY, kZ}, estimate_alone_);
      else
        read_row();
    const Eigen::Index n = std::ssize(columns_[kError]);
    if (n == 0) throw IoError(source_, "has no row");
    PoseErrors errors{.time_s = column(has(kTime) ? kTime : kPose),
                      .distance_m = column(kDistance),
                      .estimate_m = SpacePoints::Zero(n, 3),
                      .ground_truth_m = SpacePoints::Zero(n, 3),
                      .error_m = column(kError),
                      .error_deg = {},
                      .has_times = has(kTime),
                      .ground_truth_alone = poses_of(ground_truth_alone_),
                      .estimate_alone = poses_of(estimate_alone_)};
    errors.estimate_m.col(0) = column(kX);
    errors.estimate_m.col(1) = column(kY);
    errors.ground_truth_m.col(0) = column(kTrueX);
    errors.ground_truth_m.col(1) = column(kTrueY);
    if (has(kZ)) {
      errors.estimate_m.col(2) = column(kZ);
      errors.ground_truth_m.col(2) = column(kTrueZ);
    }
    if (has(kAngle)) errors.error_deg = column(kAngle);
    return errors;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(source_, fmt::format("line {}", row_.line), what);
  }

  bool has(Column column) const { return at_[column].has_value(); }

  Eigen::VectorXd column(Column column) const {
    return Eigen::Map<const Eigen::VectorXd>(columns_[column].data(), std::ssize(columns_[column]));
  }

  void read_header() {
    for (std::size_t i = 0; i < row_.cells.size(); ++i) {
      const auto known = std::ranges::find(kColumns, row_.cells[i]);
      if (known == kColumns.end()) fail("unknown column " + in_quotes(row_.cells[i]));
      std::optional<std::size_t>& at = at_[static_cast<std::size_t>(known - kColumns.begin())];
      if (at) fail(fmt::format("the column {} is there twice", *known));
      at = i;
    }
    for (const Column needed : {kDistance, kX, kY, kTrueX, kTrueY, kError})
      if (!has(needed)) fail(fmt::format("the column {} is missing", kColumns[needed]));
    if (has(kTime) == has(kPose)) fail("one of the columns time_s and pose is needed");
    if (has(kZ) != has(kTrueZ)) fail("z_m and true_z_m go together");
    width_ = row_.cells.size();
  }

  using Axes = std::array<Column, 3>;

  /// Whether the row has a time and these positions alone.
  bool has_alone(const Axes& axes) const {
    if (!has(kTime) || row_.cells.size() != width_ || row_.cells[*at_[axes[0]]].empty())
      return false;
    return std::ranges::all_of(
        std::array{kDistance, kX, kY, kZ, kTrueX, kTrueY, kTrueZ, kError, kAngle}, [&](Column one) {
          return !has(one) || std::ranges::find(axes, one) != axes.end() ||
                 row_.cells[*at_[one]].empty();
        });
  }

  static LonePoses poses_of(const std::vector<double>& rows) {
    if (rows.empty()) return {};
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>> table(
        rows.data(), std::ssize(rows) / 4, 4);
    return {table.col(0), table.rightCols<3>()};
  }

  double value_in(std::size_t column) const {
    const std::string_view cell = row_.cells[*at_[column]];
    const std::optional<double> value = number_in(cell);
    if (!value || !std::isfinite(*value)) fail(number_problem(cell));
    return *value;
  }

  void take_time(double time_s) {
    if (time_s < last_s_) fail("time_s descends");
    last_s_ = time_s;
  }

  void check_count() {
    if (++rows_ > static_cast<std::size_t>(kMostSteps))
      fail(fmt::format("more than {} rows", kMostSteps));
  }

  void read_alone(const Axes& axes, std::vector<double>& poses) {
    check_count();
    const double time_s = value_in(kTime);
    take_time(time_s);
    poses.push_back(time_s);
    for (const Column axis : axes) poses.push_back(has(axis) ? value_in(axis) : 0.0);
  }

  void read_row() {
    if (row_.cells.size() != width_)
      fail(fmt::format("{} cells where the header has {}", row_.cells.size(), width_));
    check_count();
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (!at_[i]) continue;
      const double value = value_in(i);
      std::vector<double>& values = columns_[i];
      if (i == kTime) take_time(value);
      const bool ascends = i == kPose || i == kDistance;
      if (ascends && !values.empty() && value < values.back())
        fail(fmt::format("{} descends", kColumns[i]));
      if ((i == kError || i == kAngle) && value < 0.0)
        fail(fmt::format("{} is below 0", kColumns[i]));
      values.push_back(value);
    }
  }

  const std::string& source_;
  TableReader reader_;
  TableRow row_;
  std::size_t width_ = 0;
  std::array<std::optional<std::size_t>, kColumns.size()> at_ = {};
  std::array<std::vector<double>, kColumns.size()> columns_ = {};
  std::vector<double> ground_truth_alone_, estimate_alone_;  ///< Rows of time and position.
  std::size_t rows_ = 0;
  double last_s_ = -HUGE_VAL;
};

}  // namespace

std::string pose_errors_csv(const PoseErrors& errors) {
  std::string text = errors.has_times ? "time_s" : "pose";
  const bool has_angles = errors.error_deg.size() > 0;
  for (std::size_t i = kDistance; i <= kError; ++i) text += fmt::format(",{}", kColumns[i]);
  text += has_angles ? ",error_deg\r\n" : "\r\n";
  std::vector<std::pair<double, std::string>> rows;  // By time.
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    const auto& estimate = errors.estimate_m.row(i);
    const auto& ground_truth = errors.ground_truth_m.row(i);
    rows.emplace_back(errors.time_s(i), fmt::format("{},{},{},{},{},{},{},{},{}", errors.time_s(i),
                                                    errors.distance_m(i), estimate(0), estimate(1),
                                                    estimate(2), ground_truth(0), ground_truth(1),
                                                    ground_truth(2), errors.error_m(i)));
    if (has_angles) rows.back().second += fmt::format(",{}", errors.error_deg(i));
  }
  const char* end = has_angles ? "," : "";
  for (const LonePoses* alone : {&errors.ground_truth_alone, &errors.estimate_alone})
    for (Eigen::Index i = 0; i < alone->time_s.size(); ++i) {
      const auto& at = alone->positions_m.row(i);
      const std::string position = fmt::format("{},{},{}", at(0), at(1), at(2));
      const bool is_true = alone == &errors.ground_truth_alone;
      rows.emplace_back(alone->time_s(i),
                        fmt::format("{},,{},{},{}", alone->time_s(i), is_true ? ",," : position,
                                    is_true ? position : ",,", end));
    }
  std::ranges::stable_sort(rows, {}, &std::pair<double, std::string>::first);
  for (const auto& [time, row] : rows) text += row + "\r\n";
  return text;
}

PoseErrors parse_pose_errors_csv(std::string_view text, const std::string& source) {
  return ErrorsReader(text, source).read();
}

}  // namespace mapproof
