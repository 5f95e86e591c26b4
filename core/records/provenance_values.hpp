#pragma once

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/model/study.hpp"

namespace mapproof {

/// What made a study, to and from JSON. @throws IoError with the place.
nlohmann::ordered_json provenance_value(const Provenance& provenance);
Provenance read_provenance(const JsonCursor& value);

}  // namespace mapproof
