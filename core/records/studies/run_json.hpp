#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/study.hpp"
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
  any_setting_fields(v, record.setting);
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

// The fields of what figures show of a run beyond its maps (core/json/fields.hpp):
// details/layout-L-pose-P.json.

inline EnumNames enum_names(View) { return names_up_to(View::kOutOfReach, "view"); }

namespace record_rules {

inline constexpr FieldRule kNumbers = {.nullable = true, .whole_as_integers = true};
inline constexpr FieldRule kEntries = {.nullable_entries = true, .whole_as_integers = true};

}  // namespace record_rules

template <typename Visitor>
void fields(Visitor& v, Path& path) {
  v.field("positions_m", path.positions_m, {.min_items = 1, .max_items = kMostSteps});
  v.field("headings_rad", path.headings_rad, record_rules::kNumbers);
  if (path.headings_rad.size() != path.positions_m.rows())
    v.refuse("headings_rad", fmt::format("expected {} elements, got {}", path.positions_m.rows(),
                                         path.headings_rad.size()));
}

template <typename Visitor>
void fields(Visitor& v, ObservationManifold& manifold) {
  v.about(
      "The landmarks at the first three principal coordinates of these distances, the shares of "
      "all "
      "spread, and the graph of the K nearest neighbours; left out where too few distances are "
      "known.");
  v.field("coordinates", manifold.coordinates,
          {.nullable_entries = true, .whole_as_integers = true, .columns = 3});
  v.field("shares", manifold.shares, {.minimum = 0.0, .maximum = 1e9, .nullable = true});
  v.field("K", manifold.neighbours, {.minimum = 1, .maximum = kMostLandmarks});
  v.field("edges", manifold.edges, {.minimum = 0, .maximum = kMostLandmarks - 1});
  const auto last = static_cast<int>(manifold.coordinates.rows()) - 1;
  if (manifold.neighbours > std::max(last, 1))
    v.refuse("K", fmt::format("expected an integer from 1 to {}, got {}", std::max(last, 1),
                              manifold.neighbours));
  for (std::size_t i = 0; i < manifold.edges.size(); ++i)
    if (std::max(manifold.edges[i].first, manifold.edges[i].second) > last)
      v.refuse("edges", i, fmt::format("expected integers from 0 to {}", last));
}

/// An element of SensorDetails::spectra.
struct MapSpectrum {
  MethodSetting setting;
  Eigen::VectorXd values;
};

template <typename Visitor>
void fields(Visitor& v, MapSpectrum& spectrum) {
  setting_fields(v, spectrum.setting);
  v.field("values", spectrum.values, record_rules::kNumbers);
}

/// One step of the run.
template <typename Visitor>
void scan_fields(Visitor& v, SensorDetails& sensor) {
  v.about("One step of the run; views are there for visibility alone.");
  v.field("step", sensor.scan_step, {.minimum = 1, .maximum = kMostSteps});
  v.field("reach_m", sensor.reach_m, {.minimum = 0.0, .maximum = kFarthest_m});
  v.field("views", sensor.views, {.max_items = kMostLandmarks});
  v.field("values", sensor.values, record_rules::kNumbers);
  if (!sensor.views.empty() && std::ssize(sensor.views) != sensor.values.size())
    v.refuse("views", fmt::format("expected {} views, one a value, got {}", sensor.values.size(),
                                  sensor.views.size()));
}

template <typename Visitor>
void fields(Visitor& v, SensorDetails& sensor) {
  using namespace record_rules;
  v.field("sensor", sensor.sensor);
  v.group("scan", [&](auto& scan) { scan_fields(scan, sensor); });
  v.field("first_steps", sensor.first_steps,
          {.description = "How the observation history begins, a row per landmark.",
           .nullable_entries = true,
           .whole_as_integers = true});
  v.field("step", sensor.step, {.minimum = 1, .maximum = kMostSteps});
  v.field("distances", sensor.distances,
          {.description = "Of the observation vectors at that step, row by row above the diagonal.",
           .nullable = true,
           .whole_as_integers = true});
  std::vector<MapSpectrum> spectra;
  for (const auto& [setting, values] : sensor.spectra) spectra.push_back({setting, values});
  v.field("spectra", spectra, {.max_items = kMostRecords});
  if constexpr (Visitor::kReads)
    for (MapSpectrum& spectrum : spectra)
      sensor.spectra.emplace_back(spectrum.setting, std::move(spectrum.values));
  v.field("manifold", sensor.manifold, {.key = Key::kIfAny});
  const Eigen::Index landmarks = sensor.values.size();
  const auto check = [&](std::string_view key, Eigen::Index expected, Eigen::Index size) {
    if (size != expected)
      v.refuse(key, fmt::format("expected {} elements, got {}", expected, size));
  };
  check("first_steps", landmarks, sensor.first_steps.rows());
  check("distances", landmarks * (landmarks - 1) / 2, sensor.distances.size());
  if (sensor.manifold)
    check("manifold/coordinates", landmarks, sensor.manifold->coordinates.rows());
}

template <typename Visitor>
void fields(Visitor& v, RunDetails& details) {
  v.file("mapproof.details",
         "details/layout-L-pose-P.json: what figures show of a run beyond its maps.");
  v.field("run", details.id);
  v.field("path", details.path);
  v.field("sensors", details.sensors, {.max_items = 100});
  for (std::size_t i = 0; i < details.sensors.size(); ++i)
    if (details.sensors[i].scan_step > details.path.positions_m.rows())
      v.refuse(fmt::format("sensors/{}/scan/step", i),
               fmt::format("expected an integer from 1 to {}, got {}",
                           details.path.positions_m.rows(), details.sensors[i].scan_step));
}

/// runs/layout-1-pose-2.json (mapproof.run).
std::string run_json(const Run& run);
Run parse_run(std::string_view text, const std::string& source);

/// details/layout-1-pose-2.json (mapproof.details).
std::string details_json(const RunDetails& details);
RunDetails parse_details(std::string_view text, const std::string& source);

/// The maps of one run in a file.
struct RunMaps {
  RunId run;
  std::vector<MapRecord> maps;
};

/// maps/layout-1-pose-2.json (mapproof.maps): names, ground truth and anchors once, not in every
/// map.
std::string maps_json(const RunMaps& maps);
RunMaps parse_maps(std::string_view text, const std::string& source);

/// study.json (mapproof.study): a Study without its runs.
std::string study_json(const Experiment& experiment, const Provenance& provenance);
Study parse_study(std::string_view text, const std::string& source);

}  // namespace mapproof
