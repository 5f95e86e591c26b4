#include "tests/support/schemas/comparison_schemas.hpp"

#include "core/json/json_text.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/history/history_export.hpp"
#include "tests/support/schemas/record_schema.hpp"

namespace mapproof::test {

std::map<std::string, std::string> comparison_schemas() {
  return {{"approvals.schema.json", json_text(json_schema<ApprovalsFile>())},
          {"diff.schema.json", json_text(json_schema<DiffResult>())},
          {"diff_settings.schema.json", json_text(json_schema<DiffSettings>())},
          {"decisions.schema.json", json_text(json_schema<NightlyDecisions>())},
          {"history.schema.json", json_text(json_schema<ExportedHistory>())},
          {"nightly_run.schema.json", json_text(json_schema<NightlyFile>())}};
}

}  // namespace mapproof::test
