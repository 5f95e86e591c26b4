#include "core/records/tables/cells.hpp"

#include <cmath>
#include <numbers>

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
      return fmt::format("bearings are in radians, within a full turn; {} looks like degrees",
                         value);
    case Sensor::kRange:
      return value < 0.0
                 ? fmt::format("a range cannot be negative, got {}", value)
                 : fmt::format("ranges are in metres, at most {}, got {}", kLongestRange_m, value);
  }
  return {};
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
    throw IoError(
        source, location,
        fmt::format("more than {} landmarks: each row is a landmark and each column a step; "
                    "should the table be transposed?",
                    kMostLandmarks));
  if (static_cast<double>(landmarks) * static_cast<double>(steps) > kMostEntries)
    throw IoError(source, location,
                  fmt::format("{} landmarks x {} steps are more than {:.0f} entries", landmarks,
                              steps, kMostEntries));
}

std::optional<double> detection_value(std::string_view cell, Sensor sensor, AngleUnit unit) {
  if (sensor != Sensor::kBearing || unit == AngleUnit::kRadians || is_missing(cell))
    return observation_in(cell, sensor);
  const std::optional<double> degrees = number_in(cell);
  if (!degrees || !(std::abs(*degrees) <= 360.0 + 1e-3)) return std::nullopt;
  return in_radians(*degrees);
}

std::string detection_problem(std::string_view cell, Sensor sensor, AngleUnit unit) {
  const std::optional<double> degrees = number_in(cell);
  if (sensor == Sensor::kBearing && unit == AngleUnit::kDegrees && degrees &&
      std::isfinite(*degrees))
    return fmt::format("bearings are within a full turn of 360 degrees, got {}", *degrees);
  return cell_problem(cell, sensor);
}

}  // namespace mapproof
