#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "core/model/sensor.hpp"

namespace mapproof {

/// Says what is wrong with a value as an observation of that kind; empty if nothing is. A value
/// that is missing is NaN and right.
std::string observation_problem(Sensor sensor, double value);

inline double in_radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// A cell as an observation, NaN if it is missing. Empty if it is wrong: cell_problem() gives the
/// reason.
std::optional<double> observation_in(std::string_view cell, Sensor sensor);
std::string cell_problem(std::string_view cell, Sensor sensor);

/// @param place  For the error: "line 7". @throws IoError if the history grows beyond its bounds.
void check_size(const std::string& source, const std::string& location, std::size_t landmarks,
                std::size_t steps);

/// How the values of a column are written.
struct ValueForm {
  AngleUnit unit = AngleUnit::kRadians;  ///< Of bearings.
  double factor = 1.0;                   ///< Metres of one unit of a range.
  bool is_clockwise = false;             ///< The bearings: they get the other sign.
};

/// A cell as a range in metres or a bearing in radians, counter-clockwise; NaN if it is missing.
/// Empty if it is wrong: detection_problem() gives the reason.
std::optional<double> detection_value(std::string_view cell, Sensor sensor, const ValueForm& form);
std::string detection_problem(std::string_view cell, Sensor sensor, const ValueForm& form);

}  // namespace mapproof
