#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/results/quantity.hpp"

namespace mapproof {

/// A quantity as a study's file names it: id, label, unit, better.
nlohmann::ordered_json quantity_value(const Quantity& quantity);

/// The same from a file, as study_quantity() takes it. The unit may be left out; so may all but the
/// id of a quantity that the dictionary has.
/// @throws IoError with the place.
Quantity read_quantity(const JsonCursor& value);

}  // namespace mapproof
