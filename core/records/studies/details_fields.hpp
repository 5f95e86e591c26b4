#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/model/run_details.hpp"
#include "core/records/value_fields.hpp"

namespace mapproof {

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

}  // namespace mapproof
