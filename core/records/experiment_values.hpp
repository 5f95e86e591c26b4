#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/experiment.hpp"

namespace mapproof {

/// The value that experiment_json() writes, schema included.
nlohmann::ordered_json experiment_value(const Experiment& experiment);

/// @param document  An experiment without profiles. @throws IoError with the place.
Experiment read_experiment(const JsonCursor& document);

/// What no single value shows: room for the landmarks, K below their number, sizes of the whole.
/// @throws IoError with the place in `document`, which `experiment` was read from.
void check_experiment(const Experiment& experiment, const JsonCursor& document);

/// What a paper printed on one sensor's part. @throws IoError with the place.
Published read_published(const JsonCursor& object);
nlohmann::ordered_json published_value(const Published& published);

/// That no two sensors' tables get one id, those that go with them included.
/// @throws IoError with the place in `document`.
void check_table_ids(const Experiment& experiment, const JsonCursor& document);

}  // namespace mapproof
