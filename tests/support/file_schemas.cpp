#include "tests/support/file_schemas.hpp"

#include "core/json/json_text.hpp"
#include "core/records/details_fields.hpp"
#include "core/records/map_fields.hpp"
#include "core/records/run_fields.hpp"
#include "core/records/slam_fields.hpp"
#include "core/records/space_fields.hpp"
#include "core/records/timing_fields.hpp"
#include "tests/support/record_schema.hpp"

namespace mapproof::test {
namespace {

/// A line of timings.jsonl is the schema, which is the first, or one of the records.
nlohmann::ordered_json timing_schema() {
  record_json::Definitions definitions;
  nlohmann::ordered_json lines = record_json::value_schema<TimingLine>({}, definitions);
  nlohmann::ordered_json first = {
      {"type", "object"},
      {"additionalProperties", false},
      {"required", nlohmann::ordered_json::array({"schema"})},
      {"properties", {{"schema", {{"const", {{"name", "mapproof.timings"}, {"version", 1}}}}}}}};
  lines["oneOf"].insert(lines["oneOf"].begin(), std::move(first));
  nlohmann::ordered_json whole = {
      {"title", "A line of timings.jsonl"},
      {"description",
       "The schema (first line), seconds of a piece of a study, or one start of the "
       "program."}};
  whole.update(lines);
  return record_json::file_schema(std::move(whole), definitions);
}

}  // namespace

std::map<std::string, std::string> file_schemas() {
  return {{"details.schema.json", json_text(json_schema<RunDetails>())},
          {"map.schema.json", json_text(json_schema<MapFile>())},
          {"maps.schema.json", json_text(json_schema<MapsFile>())},
          {"range_histories.schema.json", json_text(json_schema<RangeHistoryStudy>())},
          {"run.schema.json", json_text(json_schema<Run>())},
          {"slam_convergence.schema.json", json_text(json_schema<ConvergenceCurve>())},
          {"slam_run.schema.json", json_text(json_schema<SlamRun>())},
          {"space_run.schema.json", json_text(json_schema<SpaceRun>())},
          {"timing.schema.json", json_text(timing_schema())}};
}

}  // namespace mapproof::test
