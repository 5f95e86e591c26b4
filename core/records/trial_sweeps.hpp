#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/trial_study.hpp"

namespace mapproof {

/// Reads what an experiment sweeps: its sensors with their methods, and factors with their levels.
/// @param document    The experiment; all else of it is in `experiment` already.
/// @throws IoError with the place if a factor is not known, a level is out of bounds, no sensor has
///         the factors of a sweep, or a combination of levels cannot be simulated.
void read_sweeps(const JsonCursor& document, TrialExperiment& experiment);

/// Adds them, if there are any.
void put_sweeps(nlohmann::ordered_json& value, const TrialExperiment& experiment);

}  // namespace mapproof
