#include "core/records/slam_run_json.hpp"

#include "core/json/record_json.hpp"
#include "core/records/provenance_values.hpp"
#include "core/records/slam_experiment_json.hpp"
#include "core/records/slam_fields.hpp"

namespace mapproof {

std::string slam_run_json(const SlamRun& run) { return to_json_text(run); }

SlamRun parse_slam_run(std::string_view text, const std::string& source) {
  return from_json_text<SlamRun>(text, source);
}

std::string convergence_json(const ConvergenceCurve& curve) { return to_json_text(curve); }

ConvergenceCurve parse_convergence(std::string_view text, const std::string& source) {
  return from_json_text<ConvergenceCurve>(text, source);
}

std::string range_histories_json(const RangeHistoryStudy& histories) {
  return to_json_text(histories);
}

RangeHistoryStudy parse_range_histories(std::string_view text, const std::string& source) {
  return from_json_text<RangeHistoryStudy>(text, source);
}

std::string slam_study_json(const SlamExperiment& experiment, const Provenance& provenance) {
  return json_text({{"schema", schema_value("mapproof.slam_study")},
                    {"experiment", slam_experiment_value(experiment)},
                    {"provenance", provenance_value(provenance)}});
}

SlamOrder parse_slam_study(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.slam_study");
  root.allow_only({"schema", "experiment", "provenance"});
  return {.experiment = read_slam_experiment(root.at("experiment")),
          .provenance = read_provenance(root.at("provenance"))};
}

}  // namespace mapproof
