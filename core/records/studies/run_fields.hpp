#pragma once

#include "core/model/run_details.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

// The fields of what a study keeps of a run (core/json/fields.hpp): runs/layout-L-pose-P.json.

template <typename Visitor>
void fields(Visitor& v, World& world) {
  v.field("side_m", world.side_m, {.minimum = 0.0, .maximum = kFarthest_m});
  v.field("landmark_diameter_m", world.landmark_diameter_m,
          {.minimum = 0.0, .maximum = kFarthest_m});
  v.field("landmarks_m", world.landmarks_m, record_rules::kPositions);
}

template <typename Visitor>
void fields(Visitor& v, Occlusion& occlusion) {
  v.field("within_reach", occlusion.within_reach,
          {.minimum = 0, .maximum = double{kMostLandmarks} * kMostSteps});
  v.field("hidden", occlusion.hidden, {.minimum = 0});
  if (occlusion.hidden > occlusion.within_reach)
    v.refuse("hidden", fmt::format("expected an integer from 0 to {}, got {}",
                                   occlusion.within_reach, occlusion.hidden));
}

template <typename Visitor>
void fields(Visitor& v, RunRecord& record) {
  using namespace record_rules;
  v.field("sensor", record.sensor);
  setting_fields(v, record.setting);
  v.field("step", record.step, kStep);
  v.field("score", record.score, {.description = "null where no map came out."});
  v.field("iterations", record.iterations, kCount);
  v.field("stress", record.stress);
  v.field("certificate", record.certificate, {.key = Key::kIfAny});
  v.field("statuses", record.statuses, kStatuses);
}

template <typename Visitor>
void fields(Visitor& v, VariationRecord& record) {
  using namespace record_rules;
  v.field("variation", record.variation, {.max_bytes = 64});
  v.field("level", record.level, {.whole_as_integers = true});
  setting_fields(v, record.setting);
  v.field("score", record.score);
  v.field("statuses", record.statuses, kStatuses);
}

template <typename Visitor>
void fields(Visitor& v, Run& run) {
  using namespace record_rules;
  v.file("mapproof.run", "runs/layout-L-pose-P.json: a world and how every map of it came out.");
  v.field("run", run.id);
  v.field("world", run.world);
  v.field("anchors", run.anchors, kRows);
  check_rows(v, "anchors", run.anchors, run.world.landmarks_m.rows());
  // Studies made before there were variations do not have these.
  v.field(
      "occlusion", run.occlusion,
      {.description = "Detections of landmarks within reach, and how many of them another one hid.",
       .key = Key::kOptional});
  v.field("records", run.records, {.max_items = kMostRecords});
  v.field("variations", run.variations, {.max_items = kMostRecords, .key = Key::kOptional});
}

}  // namespace mapproof
