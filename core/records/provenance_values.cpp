#include "core/records/provenance_values.hpp"

#include "core/json/record_json.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

nlohmann::ordered_json provenance_value(const Provenance& provenance) {
  return to_json_value(provenance);
}

Provenance read_provenance(const JsonCursor& value) { return from_json_value<Provenance>(value); }

}  // namespace mapproof
