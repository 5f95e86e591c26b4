#include "tests/support/schemas/file_schemas.hpp"

#include "core/json/json_text.hpp"
#include "core/records/experiments/external_methods.hpp"
#include "core/records/experiments/slam_experiment_json.hpp"
#include "core/records/maps/map_fields.hpp"
#include "core/records/metrics/metrics_json.hpp"
#include "core/records/observations/observation_json.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/run_json.hpp"
#include "core/records/studies/slam_fields.hpp"
#include "core/records/studies/study_page.hpp"
#include "core/records/studies/timings_jsonl.hpp"
#include "core/records/studies/topic_json.hpp"
#include "tests/support/schemas/record_schema.hpp"

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
       "The schema (first line), seconds of a piece of a study, one start of the program, or "
       "what a task of a shard has written."}};
  whole.update(lines);
  return record_json::file_schema(std::move(whole), definitions);
}

/// The schema of the file of an experiment, which may have profiles: they are gone once one of them
/// was applied.
template <typename T>
std::string experiment_schema() {
  nlohmann::ordered_json schema = json_schema<T>();
  nlohmann::ordered_json& profiles = schema["properties"]["profiles"];
  profiles["type"] = "object";
  profiles["additionalProperties"] = {{"type", "object"},
                                      {"properties", {{"schema", false}, {"profiles", false}}}};
  profiles["description"] = "Merge patches (RFC 7396) of the experiment, by name.";
  return json_text(schema);
}

}  // namespace

std::map<std::string, std::string> file_schemas() {
  return {{"details.schema.json", json_text(json_schema<RunDetails>())},
          {"experiment.schema.json", experiment_schema<Experiment>()},
          {"map.schema.json", json_text(json_schema<MapFile>())},
          {"maps.schema.json", json_text(json_schema<MapsFile>())},
          {"methods.schema.json", json_text(json_schema<ExternalMethodsFile>())},
          {"observations.schema.json", json_text(json_schema<ObservationsFile>())},
          {"range_histories.schema.json", json_text(json_schema<RangeHistoryStudy>())},
          {"metrics.schema.json", json_text(json_schema<Metrics>())},
          {"page.schema.json", json_text(json_schema<PageData>())},
          {"results_study.schema.json", json_text(json_schema<ResultsHead>())},
          {"run.schema.json", json_text(json_schema<Run>())},
          {"detections.schema.json", json_text(json_schema<DetectionsFile>())},
          {"slam_convergence.schema.json", json_text(json_schema<ConvergenceCurve>())},
          {"slam_experiment.schema.json", experiment_schema<SlamExperiment>()},
          {"slam_run.schema.json", json_text(json_schema<SlamRun>())},
          {"slam_study.schema.json", json_text(json_schema<SlamStudyStart>())},
          {"space_run.schema.json", json_text(json_schema<SpaceRun>())},
          {"study.schema.json", json_text(json_schema<Study>())},
          {"timing.schema.json", json_text(timing_schema())},
          {"topic_experiment.schema.json", experiment_schema<TopicExperimentFile>()},
          {"topic_part.schema.json", json_text(json_schema<TopicPartFile>())},
          {"topic_study.schema.json", json_text(json_schema<TopicStudy>())}};
}

}  // namespace mapproof::test
