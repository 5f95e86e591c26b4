#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/records/observations/observations.hpp"

namespace mapproof {

/// Says what is wrong with a value as an observation of that kind; empty if nothing is. A value
/// that is missing is NaN and right.
std::string observation_problem(Sensor sensor, double value);

/// A cell as an observation, NaN if it is missing. Empty if it is wrong: cell_problem() says how.
std::optional<double> observation_in(std::string_view cell, Sensor sensor);
std::string cell_problem(std::string_view cell, Sensor sensor);

/// @param place  For the error: "line 7". @throws IoError if the history grows beyond its bounds.
void check_size(const std::string& source, const std::string& place, std::size_t landmarks,
                std::size_t steps);

/// The readers of the several forms; `text` is from checked_text().
ObservationSource read_wide(std::string_view text, const std::string& source, Sensor sensor,
                            AngleUnit unit = AngleUnit::kRadians);
ObservationSource read_long(std::string_view text, const std::string& source, Sensor sensor,
                            AngleUnit unit = AngleUnit::kRadians);
ObservationSource parse_observations(std::string_view text, const std::string& source,
                                     std::optional<Sensor> kind);

/// Whether the table's first row names the columns landmark and value, as a long one does.
bool has_long_header(std::string_view text, const std::string& source);

/// Whether a table without a header starts with a step, a landmark's name that is not a number, and
/// a value: a row that no wide table holds.
bool starts_as_long(std::string_view text, const std::string& source);

}  // namespace mapproof
