#pragma once

#include "core/model/space_slam.hpp"
#include "core/model/upgrade_clouds.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

// The fields of points in space and of space.json (core/json/fields.hpp).

inline EnumNames enum_names(Alignment) { return names_up_to(Alignment::kSimilarity, "alignment"); }

namespace record_rules {

inline constexpr FieldRule kWhole = {.whole_as_integers = true};
inline constexpr FieldRule kWholeOrNull = {.nullable = true, .whole_as_integers = true};
inline constexpr FieldRule kSpacePoints = {
    .description = "x, y, z; null: not known.", .nullable = true, .whole_as_integers = true};

}  // namespace record_rules

/// Refuses an array that is not as long as another one.
template <typename Visitor>
void check_size(Visitor& v, std::string_view key, std::ptrdiff_t size, std::ptrdiff_t expected) {
  if (size != expected) v.refuse(key, fmt::format("expected {} elements, got {}", expected, size));
}

template <typename Visitor>
void fields(Visitor& v, QuadricPoints& cloud) {
  v.type("cloud");
  v.field("points", cloud.points, {.whole_as_integers = true, .max_items = kMostSteps});
  v.field("quadric", cloud.Q, record_rules::kWhole);
  if (cloud.Q != cloud.Q.transpose()) v.refuse("quadric", "expected a symmetric matrix");
}

template <typename Visitor>
void fields(Visitor& v, UpgradeClouds& upgrade) {
  v.field("steps", upgrade.steps,
          {.minimum = 0, .maximum = kMostSteps - 1, .unique = true, .max_items = kMostSteps});
  v.field("before", upgrade.before);
  v.field("after", upgrade.after);
  const auto steps = std::ssize(upgrade.steps);
  if (upgrade.before.points.rows() != steps) v.refuse("before/points", "expected a point a step");
  if (upgrade.after.points.rows() != steps) v.refuse("after/points", "expected a point a step");
}

template <typename Visitor>
void fields(Visitor& v, SpaceRecord& record) {
  using namespace record_rules;
  SpaceEstimate& estimate = record.estimate;
  v.field("knows_landmarks", record.knows_landmarks);
  v.field("statuses", estimate.statuses, kStatuses);
  v.field("alignment", record.alignment);
  v.field("landmarks_error_m", record.landmarks_error_m, kWhole);
  v.field("positions_error_m", record.positions_error_m, kWhole);
  v.field("range_scale", estimate.range_scale, kWhole);
  v.field("condition", estimate.condition, kWhole);
  v.field("singular_values", estimate.singular_values, kWhole);
  v.field("noise_level", estimate.noise_level, kWhole);
  v.field("landmarks_m", estimate.landmarks_m, kSpacePoints);
  v.field("positions_m", estimate.positions_m, kWhole);
}

template <typename Visitor>
void fields(Visitor& v, SpaceRun& run) {
  using namespace record_rules;
  v.file("mapproof.space_run", "space.json: a flight and what was made of its ranges.");
  v.field("noise", run.noise, {.max_bytes = 200});
  v.field("known", run.known, kRows);
  v.field("landmarks_m", run.landmarks_m, {.whole_as_integers = true, .max_items = kMostLandmarks});
  v.field("positions_m", run.positions_m, {.whole_as_integers = true, .max_items = kMostSteps});
  v.field("records", run.records, {.max_items = 2});
  check_rows(v, "known", run.known, run.landmarks_m.rows());
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    const SpaceEstimate& estimate = run.records[i].estimate;
    if (estimate.landmarks_m.rows() != run.landmarks_m.rows())
      v.refuse(fmt::format("records/{}/landmarks_m", i),
               "expected a place, or null, for each landmark");
    if (!estimate.empty() && estimate.positions_m.rows() != run.positions_m.rows())
      v.refuse(fmt::format("records/{}/positions_m", i), "expected a position a step, or none");
  }
}

}  // namespace mapproof
