#pragma once

#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
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

/// What keeps landmarks from being scattered over the room; empty: nothing.
std::string room_problem(const WorldOptions& world);

/// What keeps one of an experiment's runs from being simulated and mapped, whatever its sensors'
/// checkpoints; empty: nothing.
std::string run_problem(const Experiment& experiment);

/// What a paper printed on one sensor's part. @throws IoError with the place.
Published read_published(const JsonCursor& object);
nlohmann::ordered_json published_value(const Published& published);

/// That no two sensors' tables get one id, those that go with them included.
/// @throws IoError with the place in `document`.
void check_table_ids(const Experiment& experiment, const JsonCursor& document);

/// Parts of an experiment, each with its counterpart for writing. Readers throw IoError with the
/// place.
std::vector<MethodGrid> read_methods(const JsonCursor& object);
nlohmann::ordered_json methods_value(const std::vector<MethodGrid>& grids);

/// @param methods  What `grids` were read from. @throws IoError at a K of `landmarks` or more.
void check_grids(const std::vector<MethodGrid>& grids, int landmarks, const JsonCursor& methods);

/// @param steps  The only checkpoint of every sensor, which then names none; empty: each its own.
std::vector<SensorStudy> read_sensors(const JsonCursor& object,
                                      std::optional<int> steps = std::nullopt);
/// @param steps  As above: no checkpoints are written.
nlohmann::ordered_json sensors_value(const std::vector<SensorStudy>& sensors,
                                     std::optional<int> steps = std::nullopt);

WorldOptions read_world_options(const JsonCursor& object);
nlohmann::ordered_json world_value(const WorldOptions& world);

WalkOptions read_walk_options(const JsonCursor& object);
nlohmann::ordered_json walk_value(const WalkOptions& walk);

AnchorPlacement read_anchor_placement(const JsonCursor& value);

/// Variations and figures, which rest on everything else in the experiment.
void read_extras(const JsonCursor& document, Experiment& experiment);
void put_extras(nlohmann::ordered_json& value, const Experiment& experiment);

/// At least one value, each above the one before it.
template <typename Value, typename Read>
std::vector<Value> read_ascending(const JsonCursor& array, Read read_one) {
  std::vector<Value> values;
  for (const JsonCursor& item : array.elements(1, 1000)) {
    const Value value = read_one(item);
    if (!values.empty() && value <= values.back())
      item.fail(
          fmt::format("expected values in ascending order, got {} after {}", value, values.back()));
    values.push_back(value);
  }
  return values;
}

}  // namespace mapproof
