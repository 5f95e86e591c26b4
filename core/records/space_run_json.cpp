#include "core/records/space_run_json.hpp"

#include "core/base/not_finite.hpp"
#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"
#include "core/records/json_values.hpp"
#include "core/records/slam_values.hpp"
#include "core/records/space_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

Json record_value(const SpaceRecord& record) {
  const SpaceEstimate& estimate = record.estimate;
  return {{"knows_landmarks", record.knows_landmarks},
          {"statuses", statuses_value(estimate.statuses)},
          {"alignment", name(record.alignment)},
          {"landmarks_error_m", optional_value(record.landmarks_error_m)},
          {"positions_error_m", optional_value(record.positions_error_m)},
          {"range_scale", number_value(estimate.range_scale)},
          {"condition", optional_value(estimate.condition)},
          {"singular_values", numbers_value(estimate.singular_values)},
          {"noise_level", optional_value(estimate.noise_level)},
          {"landmarks_m", space_points_value(estimate.landmarks_m)},
          {"positions_m", space_points_value(estimate.positions_m)}};
}

SpaceEstimate read_estimate(const JsonCursor& value, const SpaceRun& run) {
  SpaceEstimate estimate;
  estimate.statuses = read_statuses(value.at("statuses"));
  estimate.range_scale = value.at("range_scale").number(-kInfinity, kInfinity);
  estimate.condition = read_optional(value.at("condition"));
  estimate.singular_values = read_finite(value.at("singular_values"));
  estimate.noise_level = read_optional(value.at("noise_level"));
  estimate.landmarks_m = read_space_points(value.at("landmarks_m"), kMostLandmarks);
  if (estimate.landmarks_m.rows() != run.landmarks_m.rows())
    value.at("landmarks_m").fail("expected a place, or null, for each landmark");
  estimate.positions_m = read_space_points(value.at("positions_m"), kMostSteps);
  if (!estimate.empty() &&
      (estimate.positions_m.rows() != run.positions_m.rows() || !estimate.positions_m.allFinite()))
    value.at("positions_m").fail("expected a position a step, or none");
  return estimate;
}

SpaceRecord read_record(const JsonCursor& value, const SpaceRun& run) {
  value.allow_only({"knows_landmarks", "statuses", "alignment", "landmarks_error_m",
                    "positions_error_m", "range_scale", "condition", "singular_values",
                    "noise_level", "landmarks_m", "positions_m"});
  const JsonCursor alignment = value.at("alignment");
  const std::optional<Alignment> known = alignment_named(alignment.text());
  if (!known) alignment.fail("unknown alignment " + in_quotes(alignment.text()));
  return {.knows_landmarks = value.at("knows_landmarks").boolean(),
          .estimate = read_estimate(value, run),
          .alignment = *known,
          .landmarks_error_m = read_optional(value.at("landmarks_error_m")),
          .positions_error_m = read_optional(value.at("positions_error_m"))};
}

/// Of the truth, which lacks nothing.
SpacePoints read_truth(const JsonCursor& value, std::size_t most) {
  SpacePoints points = read_space_points(value, most);
  if (!points.allFinite()) value.fail("expected finite places");
  return points;
}

}  // namespace

std::string space_run_json(const SpaceRun& run) {
  Json records = Json::array();
  for (const SpaceRecord& record : run.records) records.push_back(record_value(record));
  return json_text({{"schema", schema_value("mapproof.space_run")},
                    {"noise", run.noise},
                    {"known", indices_value(run.known)},
                    {"landmarks_m", space_points_value(run.landmarks_m)},
                    {"positions_m", space_points_value(run.positions_m)},
                    {"records", std::move(records)}});
}

SpaceRun parse_space_run(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  const JsonCursor root = document.cursor();
  expect_schema(root, "mapproof.space_run");
  root.allow_only({"schema", "noise", "known", "landmarks_m", "positions_m", "records"});
  SpaceRun run;
  run.noise = root.at("noise").text(200);
  run.landmarks_m = read_truth(root.at("landmarks_m"), kMostLandmarks);
  run.positions_m = read_truth(root.at("positions_m"), kMostSteps);
  run.known = read_indices(root.at("known"), run.landmarks_m.rows());
  for (const JsonCursor& record : root.at("records").elements(0, 2))
    run.records.push_back(read_record(record, run));
  return run;
}

}  // namespace mapproof
