#include "app/own_input.hpp"

#include <filesystem>
#include <limits>
#include <utility>

#include "app/own_sightings.hpp"
#include "core/records/sightings.hpp"

namespace mapproof {

std::string kind_of(const OwnInput& input) {
  std::error_code error;
  if (!input.kind.empty() || std::filesystem::is_directory(input.path, error)) return input.kind;
  return input.layout == Layout::kAuto && is_sightings(input.path) ? std::string(kRangeBearing)
                                                                   : std::string();
}

namespace {

/// Sightings whose labels are checked, if that was asked for.
SightingSource sightings_of(const OwnInput& input) {
  SightingSource source = read_sightings(input.path, {.unit = input.unit, .value = std::nullopt});
  if (!input.labels.asked()) return source;
  LabelOutcome outcome = with_labels_checked(source.log, input.labels);
  source.log = std::move(outcome.log);
  source.remarks.insert(source.remarks.end(), outcome.remarks.begin(), outcome.remarks.end());
  const auto landmarks = std::ssize(source.log.names);
  source.places.resize(static_cast<std::size_t>(landmarks));
  if (!source.truth_m || source.truth_m->rows() == landmarks) return source;
  // Where a landmark moved to, the survey does not say.
  Points truth_m = Points::Constant(landmarks, 2, std::numeric_limits<double>::quiet_NaN());
  truth_m.topRows(source.truth_m->rows()) = *source.truth_m;
  source.truth_m = truth_m;
  return source;
}

}  // namespace

OwnMap map_input(const OwnInput& input, const std::optional<NamedPointsFile>& anchors,
                 const std::optional<NamedPointsFile>& truth, const OwnMapOptions& options) {
  const std::string kind = kind_of(input);
  const std::optional<Sensor> sensor = kind.empty() ? std::nullopt : sensor_named(kind);
  if (kind == kRangeBearing)
    return map_pairs(sightings_of(input), anchors, truth, options, input.rigid);
  const bool as_usual = options.missing.way == MissingChoice().way && options.submaps == 0 &&
                        !input.labels.asked() && !options.choose && options.ellipse_replicates == 0;
  if (sensor && as_usual && input.layout != Layout::kWide && is_large_long_table(input.path))
    return map_sparse(read_sightings(input.path, {.unit = input.unit, .value = sensor}), *sensor,
                      anchors, truth, options);
  ObservationSource source = read_observations(input.path, sensor, input.layout, input.unit);
  check_labels_of(source, input.labels);
  return map_own(source, anchors, truth, options);
}

}  // namespace mapproof
