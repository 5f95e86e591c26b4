#include "core/records/tables/cells.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"

namespace mapproof {
namespace {

/// A little more than a full turn, for files with rounded numbers.
constexpr double kLargestBearing_rad = 2.0 * std::numbers::pi + 1e-3;

bool is_good(Sensor sensor, double value) {
  switch (sensor) {
    case Sensor::kVisibility:
      return value == 0.0 || value == 1.0;
    case Sensor::kBearing:
      return std::abs(value) <= kLargestBearing_rad;
    case Sensor::kRange:
      return value >= 0.0 && value <= kLongestRange_m;
  }
  return false;
}

}  // namespace

std::string observation_problem(Sensor sensor, double value) {
  if (std::isnan(value) || is_good(sensor, value)) return {};
  if (std::isinf(value)) return "an infinite value";
  switch (sensor) {
    case Sensor::kVisibility:
      return fmt::format("visibility is 0 or 1, got {}", value);
    case Sensor::kBearing:
      return fmt::format(
          "bearings are in radians from the heading, counter-clockwise, within a full turn; "
          "{} looks like degrees: --degrees",
          value);
    case Sensor::kRange:
      return value < 0.0
                 ? fmt::format("a range cannot be negative, got {}: is it a bearing?", value)
                 : fmt::format("ranges are in metres, at most {}, got {}", kLongestRange_m, value);
  }
  return {};
}

void FullTurn::add(double value, double before) {
  if (std::isnan(value)) return;
  smallest_ = std::min(smallest_, value);
  largest_ = std::max(largest_, value);
  // A robot that turns by less than an eighth of a turn between two steps.
  constexpr double kJump = 0.75;
  const double jump = std::abs(value - before);  // NaN: no jump.
  degree_jumps_ += jump > kJump * 360.0 ? 1 : 0;
  radian_jumps_ += jump > kJump * 2.0 * std::numbers::pi ? 1 : 0;
}

std::string FullTurn::remark() const {
  constexpr double kEnd = 0.05;  // Share of the turn within which both ends are reached.
  constexpr std::size_t kFewestJumps = 3;
  const auto fills = [&](double turn, std::size_t jumps) {
    return jumps >= kFewestJumps && smallest_ < kEnd * turn && largest_ > (1.0 - kEnd) * turn &&
           largest_ < turn + 1e-3;
  };
  const bool is_degrees = fills(360.0, degree_jumps_);
  if (!is_degrees && !fills(2.0 * std::numbers::pi, radian_jumps_)) return {};
  return fmt::format(
      "The ranges fill {:.4g} to {:.4g} and jump between these ends, as angles of a full turn do. "
      "If "
      "they are bearings: map --sensor bearing{}",
      smallest_, largest_, is_degrees ? " --degrees" : "");
}

void remark_on_angles(const HistoryBlocks& ranges, std::vector<std::string>& remarks) {
  FullTurn turn;
  Eigen::VectorXd before = Eigen::VectorXd::Constant(ranges.landmarks(), kNaN);
  for_blocks(ranges, ranges.steps(), [&](Eigen::Index, const Eigen::MatrixXd& values) {
    for (Eigen::Index j = 0; j < values.cols(); ++j) {
      for (Eigen::Index i = 0; i < values.rows(); ++i) turn.add(values(i, j), before(i));
      before = values.col(j);
    }
  });
  if (std::string remark = turn.remark(); !remark.empty()) remarks.push_back(std::move(remark));
}

std::optional<double> observation_in(std::string_view cell, Sensor sensor) {
  if (cell.size() == 1 && (cell[0] == '0' || cell[0] == '1')) return cell[0] - '0';
  if (is_missing(cell)) return kNaN;
  const std::optional<double> value = number_in(cell);
  if (!value || !is_good(sensor, *value)) return std::nullopt;
  return value;
}

std::string cell_problem(std::string_view cell, Sensor sensor) {
  const std::optional<double> value = number_in(cell);
  if (!value) return number_problem(cell);
  const std::string problem = observation_problem(sensor, *value);
  return problem.empty() ? number_problem(cell) : problem;
}

void check_size(const std::string& source, const std::string& location, std::size_t landmarks,
                std::size_t steps) {
  if (steps > kMostSteps)
    throw IoError(source, location, fmt::format("{} steps; at most {}", steps, kMostSteps));
  if (landmarks > kMostLandmarks)
    throw IoError(source, location, fmt::format("more than {} landmarks", kMostLandmarks));
  if (static_cast<double>(landmarks) * static_cast<double>(steps) > kMostEntries)
    throw IoError(source, location,
                  fmt::format("{} landmarks x {} steps are more than {:.0f} entries", landmarks,
                              steps, kMostEntries));
}

std::optional<double> detection_of(double number, Sensor sensor, const ValueForm& form) {
  if (sensor == Sensor::kRange) number *= form.factor;
  if (sensor != Sensor::kBearing || (form.unit == AngleUnit::kRadians && !form.is_clockwise))
    return is_good(sensor, number) ? std::optional(number) : std::nullopt;
  const bool is_degrees = form.unit == AngleUnit::kDegrees;
  if (!(std::abs(number) <= (is_degrees ? 360.0 + 1e-3 : kLargestBearing_rad))) return std::nullopt;
  const double radians = is_degrees ? in_radians(number) : number;
  return form.is_clockwise ? 0.0 - radians : radians;
}

std::optional<double> detection_value(std::string_view cell, Sensor sensor, const ValueForm& form) {
  if (is_missing(cell)) return kNaN;
  const std::optional<double> number = number_in(cell);
  return number ? detection_of(*number, sensor, form) : std::nullopt;
}

std::string detection_problem(std::string_view cell, Sensor sensor, const ValueForm& form) {
  const std::optional<double> number = number_in(cell);
  if (!number || !std::isfinite(*number)) return cell_problem(cell, sensor);
  if (sensor == Sensor::kBearing && form.unit == AngleUnit::kDegrees)
    return fmt::format(
        "bearings are in degrees from the heading, within a full turn of 360; got {}", *number);
  if (sensor == Sensor::kRange) return observation_problem(sensor, *number * form.factor);
  return cell_problem(cell, sensor);
}

}  // namespace mapproof
