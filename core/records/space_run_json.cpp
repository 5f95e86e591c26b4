#include "core/records/space_run_json.hpp"

#include "core/json/record_json.hpp"
#include "core/records/space_fields.hpp"

namespace mapproof {

std::string space_run_json(const SpaceRun& run) { return to_json_text(run); }

SpaceRun parse_space_run(std::string_view text, const std::string& source) {
  return from_json_text<SpaceRun>(text, source);
}

}  // namespace mapproof
