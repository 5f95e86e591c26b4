#include "core/records/evaluations/pose_errors_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
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
enum Column : std::size_t { kTime, kPose, kDistance, kX, kY, kZ, kTrueX, kTrueY, kTrueZ, kError,
                            kAngle };

class ErrorsReader {
 public:
  ErrorsReader(std::string_view text, const std::string& source)
      : source_(source), reader_(text, source, ',') {}

  PoseErrors read() {
    if (!reader_.next(row_)) throw IoError(source_, "has no header");
    read_header();
    while (reader_.next(row_)) read_row();
    const Eigen::Index n = std::ssize(columns_[kError]);
    if (n == 0) throw IoError(source_, "has no row");
    PoseErrors errors{.time_s = column(has(kTime) ? kTime : kPose),
                      .distance_m = column(kDistance),
                      .estimate_m = SpacePoints::Zero(n, 3),
                      .ground_truth_m = SpacePoints::Zero(n, 3),
                      .error_m = column(kError),
                      .error_deg = {},
                      .has_times = has(kTime)};
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
    return Eigen::Map<const Eigen::VectorXd>(columns_[column].data(),
                                             std::ssize(columns_[column]));
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

  void read_row() {
    if (row_.cells.size() != width_)
      fail(fmt::format("{} cells where the header has {}", row_.cells.size(), width_));
    if (columns_[kError].size() >= static_cast<std::size_t>(kMostSteps))
      fail(fmt::format("more than {} rows", kMostSteps));
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
      if (!at_[i]) continue;
      const std::string_view cell = row_.cells[*at_[i]];
      const std::optional<double> value = number_in(cell);
      if (!value || !std::isfinite(*value)) fail(number_problem(cell));
      std::vector<double>& values = columns_[i];
      const bool ascends = i == kTime || i == kPose || i == kDistance;
      if (ascends && !values.empty() && *value < values.back())
        fail(fmt::format("{} descends", kColumns[i]));
      if ((i == kError || i == kAngle) && *value < 0.0)
        fail(fmt::format("{} is below 0", kColumns[i]));
      values.push_back(*value);
    }
  }

  const std::string& source_;
  TableReader reader_;
  TableRow row_;
  std::size_t width_ = 0;
  std::array<std::optional<std::size_t>, kColumns.size()> at_ = {};
  std::array<std::vector<double>, kColumns.size()> columns_ = {};
};

}  // namespace

std::string pose_errors_csv(const PoseErrors& errors) {
  std::string text = errors.has_times ? "time_s" : "pose";
  const bool has_angles = errors.error_deg.size() > 0;
  for (std::size_t i = kDistance; i <= kError; ++i) text += fmt::format(",{}", kColumns[i]);
  text += has_angles ? ",error_deg\r\n" : "\r\n";
  for (Eigen::Index i = 0; i < errors.size(); ++i) {
    const auto& estimate = errors.estimate_m.row(i);
    const auto& ground_truth = errors.ground_truth_m.row(i);
    fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{},{},{},{}", errors.time_s(i),
                   errors.distance_m(i), estimate(0), estimate(1), estimate(2), ground_truth(0),
                   ground_truth(1), ground_truth(2), errors.error_m(i));
    if (has_angles) fmt::format_to(std::back_inserter(text), ",{}", errors.error_deg(i));
    text += "\r\n";
  }
  return text;
}

PoseErrors parse_pose_errors_csv(std::string_view text, const std::string& source) {
  return ErrorsReader(text, source).read();
}

}  // namespace mapproof
