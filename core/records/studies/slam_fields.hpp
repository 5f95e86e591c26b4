#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/model/slam/slam.hpp"
#include "core/model/slam/slam_study.hpp"
#include "core/records/fit_fields.hpp"
#include "core/records/text_forms.hpp"
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
  v.field("landmarks_m", run.landmarks_m,
          {.whole_as_integers = true, .max_items = kMostRangeLandmarks});
  v.field("positions_m", run.positions_m, {.whole_as_integers = true, .max_items = kMostSteps});
  v.field("records", run.records, {.max_items = 2});
  check_rows(v, "known", run.known, run.landmarks_m.rows());
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    const SpaceEstimate& estimate = run.records[i].estimate;
    if (estimate.landmarks_m.rows() != run.landmarks_m.rows())
      v.refuse(fmt::format("records/{}/landmarks_m", i),
               "expected a position, or null, for each landmark");
    if (!estimate.empty() && estimate.positions_m.rows() != run.positions_m.rows())
      v.refuse(fmt::format("records/{}/positions_m", i), "expected a position a step, or none");
  }
}

// The fields of the files of a range-only study (core/json/fields.hpp).

inline EnumNames enum_names(SlamMethod) {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all;
    for (const SlamMethodInfo& method : all_slam_methods()) all.push_back(method.name);
    return all;
  }();
  return {"slam_method", names};
}

namespace record_rules {

inline constexpr FieldRule kError = {.minimum = 0.0};
inline constexpr FieldRule kCovariances = {
    .description = "[xx, xy, yy]; null: not known.", .nullable = true, .upper_triangle = true};

}  // namespace record_rules

template <typename Visitor>
void fields(Visitor& v, RangeMeasurement& measured) {
  v.field("time_s", measured.time_s, record_rules::kWhole);
  v.field("landmark", measured.landmark, {.minimum = 0, .maximum = kMostRangeLandmarks - 1});
  v.field("range_m", measured.range_m, record_rules::kWhole);
}

template <typename Visitor>
void fields(Visitor& v, Motion& motion) {
  v.field("time_s", motion.time_s, record_rules::kWhole);
  v.field("distance_m", motion.distance_m, record_rules::kWhole);
  v.field("heading_change_rad", motion.heading_change_rad, record_rules::kWhole);
  v.field("sideways_m", motion.sideways_m, record_rules::kWhole);
}

inline auto as_tuple(StartPose& start) {
  return std::tie(start.time_s, start.x_m, start.y_m, start.heading_rad);
}

template <typename Visitor>
void fields(Visitor& v, Trajectory& path) {
  using namespace record_rules;
  v.type("path");
  v.field("time_s", path.time_s, kWhole);
  Eigen::VectorXd x_m = path.positions_m.col(0), y_m = path.positions_m.col(1);
  std::optional<Eigen::VectorXd> heading_rad;
  if (path.heading_rad.size() > 0) heading_rad = path.heading_rad;
  v.field("x_m", x_m, kWhole);
  v.field("y_m", y_m, kWhole);
  v.field("heading_rad", heading_rad, kWhole);
  if constexpr (Visitor::kReads) {
    check_size(v, "x_m", x_m.size(), path.size());
    check_size(v, "y_m", y_m.size(), path.size());
    if (heading_rad) check_size(v, "heading_rad", heading_rad->size(), path.size());
    path.positions_m.resize(path.size(), 2);
    path.positions_m << x_m, y_m;
    path.heading_rad = heading_rad.value_or(Eigen::VectorXd());
    for (Eigen::Index i = 1; i < path.size(); ++i)
      if (!(path.time_s(i) > path.time_s(i - 1)))
        v.refuse("time_s", static_cast<std::size_t>(i), "expected ascending times");
  }
}

template <typename Visitor>
void fields(Visitor& v, RangeLog& log) {
  using namespace record_rules;
  v.field("name", log.name, {.max_bytes = kLongestName});
  v.field("landmarks", log.landmarks, kNames);
  v.field("true_landmarks_m", log.true_landmarks, kPositions);
  v.field("remarks", log.remarks, {.max_items = 10'000, .max_bytes = kLongestText});
  v.field("start", log.start,
          {.description = "Time, x, y and heading.", .whole_as_integers = true});
  v.field("ranges", log.ranges, {.as_columns = true});
  v.field("odometry", log.odometry, {.as_columns = true});
  v.field("ground_truth", log.ground_truth);
  const auto landmarks = std::ssize(log.landmarks);
  if (log.true_landmarks && log.true_landmarks->rows() != landmarks)
    v.refuse("true_landmarks_m", "expected a position, or null, for each landmark");
  for (std::size_t i = 0; i < log.ranges.size(); ++i)
    if (log.ranges[i].landmark >= landmarks)
      v.refuse("ranges/landmark", i,
               fmt::format("expected an integer from 0 to {}, got {}", landmarks - 1,
                           log.ranges[i].landmark));
}

template <typename Visitor>
void fields(Visitor& v, TrajectoryError& error) {
  using namespace record_rules;
  v.field("alignment", error.alignment);
  v.field("path_mean_m", error.mean_m, kError);
  v.field("path_rmse_m", error.rmse_m, kError);
  v.field("last_tenth_m", error.last_tenth_m, kError);
  v.field("best_tenth_m", error.best_tenth_m, kError);
  v.field("worst_tenth_m", error.worst_tenth_m, kError);
  v.field("landmarks_m", error.landmarks_m, kWhole);
}

template <typename Visitor>
void fields(Visitor& v, SlamRecord& record) {
  using namespace record_rules;
  SlamEstimate& estimate = record.estimate;
  v.field("method", record.method);
  v.field("statuses", estimate.statuses, kStatuses);
  v.field("errors", record.errors, {.max_items = 4});
  v.field("range_scale", estimate.range_scale, kWhole);
  v.field("condition", estimate.condition, kWhole);
  v.field("iterations", estimate.iterations, kCount);
  v.field("cost", estimate.cost, kWhole);
  v.field("singular_values", estimate.singular_values, kWhole);
  v.field("noise_level", estimate.noise_level, kWhole);
  v.field("landmarks_m", estimate.landmarks_m, kPositions);
  v.field("landmark_cov_m2", estimate.landmark_cov_m2, kCovariances);
  v.field("path", estimate.path);
  v.field("position_cov_rows", estimate.position_cov_rows, {.minimum = 0});
  v.field("position_cov_m2", estimate.position_cov_m2, kCovariances);
  v.field("error_m", record.error_m, {.minimum = 0.0, .nullable = true, .whole_as_integers = true});
  if constexpr (Visitor::kReads) {
    const auto& rows = estimate.position_cov_rows;
    check_rows(v, "position_cov_rows", rows, estimate.path.size());
    for (std::size_t i = 1; i < rows.size(); ++i)
      if (rows[i] <= rows[i - 1]) v.refuse("position_cov_rows", i, "expected ascending rows");
    check_size(v, "position_cov_m2", std::ssize(estimate.position_cov_m2), std::ssize(rows));
    if (!record.error_m.empty() && std::ssize(record.error_m) != estimate.path.size())
      v.refuse("error_m", "expected an error a pose");
  }
}

template <typename Visitor>
void fields(Visitor& v, WindowCurve& windows) {
  v.field("lengths_s", windows.lengths_s);
  v.field("held_out_m", windows.held_out_m,
          {.minimum = 0.0, .nullable = true, .whole_as_integers = true});
  v.field("chosen_s", windows.chosen_s, {.minimum = 0.0, .whole_as_integers = true});
  check_size(v, "held_out_m", std::ssize(windows.held_out_m), std::ssize(windows.lengths_s));
}

template <typename Visitor>
void fields(Visitor& v, RefinementStart& start) {
  using namespace record_rules;
  v.field("method", start.method);
  v.field("number", start.number, {.minimum = 1});
  v.field("cost", start.cost, kWholeOrNull);
  v.field("path_mean_m", start.mean_m, kWhole);
  v.field("iterations", start.iterations, kCount);
  v.field("converged", start.converged);
}

template <typename Visitor>
void fields(Visitor& v, PublishedDrive& drive) {
  v.field("length_km", drive.length_km,
          {.description = "Length of the drive, km.", .minimum = 0.0});
  v.field("poses", drive.poses, {.description = "Number of poses.", .minimum = 0, .maximum = 1e9});
  v.field("measurements", drive.measurements,
          {.description = "Number of ranges.", .minimum = 0, .maximum = 1e9});
}

template <typename Visitor>
void fields(Visitor& v, SlamRun& run) {
  using namespace record_rules;
  v.file("mapproof.slam_run", "runs/ID.json or slam.json: a log and what each method made of it.");
  v.field("id", run.id, kId);
  v.field("figure", run.figure,
          {.description = "Id of the figure of its paths; empty: made of the id.",
           .max_bytes = 64,
           .form = &kPlainIdOrNone});
  v.field("simulated", run.simulated);
  v.field("log", run.log);
  v.field("known", run.known, kRows);
  v.field("windows", run.windows);
  v.field("records", run.records, {.max_items = all_slam_methods().size()});
  v.field("starts", run.starts, {.max_items = 1000});
  v.field("upgrade", run.upgrade,
          {.description = "Missing in studies of older versions.", .key = Key::kOptional});
  v.field("published", run.published);
  v.field("fit", run.fit,
          {.description = "Missing in studies of older versions.", .key = Key::kIfAny});
  v.field("fitted_ranges", run.fitted_ranges,
          {.description = "What the fit leaves of the ranges: prediction less range in standard "
                          "deviations, and the probability that a range is not an outlier.",
           .as_columns = true,
           .key = Key::kIfAny});
  const auto landmarks = std::ssize(run.log.landmarks);
  check_rows(v, "known", run.known, landmarks);
  for (std::size_t i = 0; i < run.records.size(); ++i) {
    const SlamEstimate& estimate = run.records[i].estimate;
    if (estimate.landmarks_m.rows() != landmarks)
      v.refuse(fmt::format("records/{}/landmarks_m", i),
               "expected a position, or null, for each landmark");
    if (std::ssize(estimate.landmark_cov_m2) > landmarks)
      v.refuse(fmt::format("records/{}/landmark_cov_m2", i),
               fmt::format("expected at most {} elements, got {}", landmarks,
                           estimate.landmark_cov_m2.size()));
  }
}

template <typename Visitor>
void fields(Visitor& v, MeanEstimate& mean) {
  using namespace record_rules;
  v.type("mean");
  v.field("mean", mean.mean, kWholeOrNull);
  v.field("values", mean.values, kCount);
  v.field("clusters", mean.clusters, kCount);
  v.field("half_width", mean.half_width, kWhole);
}

template <typename Visitor>
void fields(Visitor& v, ConvergencePoint& point) {
  v.field("steps", point.steps, {.minimum = 1, .maximum = kMostSteps});
  v.field("observation_error", point.observation);
  v.field("landmarks_m", point.landmarks_m);
  v.field("positions_m", point.positions_m);
  v.field("sine", point.sine);
  v.field("bound", point.bound, {.minimum = 0.0, .nullable = true, .whole_as_integers = true});
}

template <typename Visitor>
void fields(Visitor& v, ConvergenceCurve& curve) {
  using namespace record_rules;
  v.file("mapproof.slam_convergence",
         "convergence/ID.json: errors over random worlds, as steps are added.");
  v.field("id", curve.id, kId);
  v.field("title", curve.title, {.max_bytes = 200});
  v.field("landmarks", curve.landmarks, {.minimum = 1, .maximum = kMostRangeLandmarks});
  v.field("slope", curve.slope, kWholeOrNull);
  v.field("points", curve.points, {.max_items = 1000});
}

template <typename Visitor>
void fields(Visitor& v, RangeHistoryMap& map) {
  using namespace record_rules;
  std::optional<Method> method;
  std::optional<double> parameter;
  if (map.setting) {
    method = map.setting->method;
    parameter = map.setting->parameter;
  }
  v.field("method", method,
          {.description = "Left out: the spectral map.", .key = Key::kIfAny, .decides = true});
  parameter_fields(v, method ? info(*method).parameter : std::nullopt, parameter);
  if constexpr (Visitor::kReads)
    if (method) map.setting = MethodSetting{*method, parameter};
  v.field("squared", map.squared);
  v.field("score", map.score);
  v.field("statuses", map.statuses, kStatuses);
  v.field("positions_m", map.positions_m, kPositions);
}

template <typename Visitor>
void fields(Visitor& v, RangeHistoryStudy& histories) {
  using namespace record_rules;
  v.file("mapproof.range_histories", "histories.json: the mapping methods on ranges of one world.");
  v.field("steps", histories.steps, {.minimum = 1, .maximum = kMostSteps});
  v.field("landmarks_m", histories.landmarks_m, kPositions);
  v.field("maps", histories.maps, {.max_items = 1000});
  for (std::size_t i = 0; i < histories.maps.size(); ++i)
    if (histories.maps[i].positions_m.rows() != histories.landmarks_m.rows())
      v.refuse(fmt::format("maps/{}/positions_m", i),
               "expected a position, or null, for each landmark");
}

}  // namespace mapproof
