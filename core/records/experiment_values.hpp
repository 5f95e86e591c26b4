#pragma once

#include <nlohmann/json.hpp>

#include "core/model/experiment.hpp"
#include "core/records/json_cursor.hpp"

namespace mapproof {

/// The value that experiment_json() writes, schema included.
nlohmann::ordered_json experiment_value(const Experiment& experiment);

/// @param document  An experiment without profiles. @throws IoError with the place.
Experiment read_experiment(const JsonCursor& document);

/// What no single value shows: room for the landmarks, K below their number, sizes of the whole.
/// @throws IoError with the place in `document`, which `experiment` was read from.
void check_experiment(const Experiment& experiment, const JsonCursor& document);

}  // namespace mapproof
