#include "core/json/record_json.hpp"
#include "reports/diff/diff_fields.hpp"
#include "reports/diff/diff_outputs.hpp"

namespace mapproof {

nlohmann::ordered_json diff_json(const DiffResult& result) { return to_json_value(result); }

}  // namespace mapproof
