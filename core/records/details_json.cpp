#include "core/json/record_json.hpp"
#include "core/records/details_fields.hpp"
#include "core/records/run_json.hpp"

namespace mapproof {

std::string details_json(const RunDetails& details) { return to_json_text(details); }

RunDetails parse_details(std::string_view text, const std::string& source) {
  return from_json_text<RunDetails>(text, source);
}

}  // namespace mapproof
