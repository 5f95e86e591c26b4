#include "app/map/observations.hpp"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/map/joint_map.hpp"
#include "app/map/range_bearing.hpp"
#include "core/base/errors.hpp"
#include "core/base/input_file.hpp"
#include "core/records/observations/detections.hpp"

namespace mapproof {
namespace {

void add_labels(CheckedLabels labels, MapResult& map) {
  map.labels = std::move(labels.facts);
  map.warnings.insert(map.warnings.begin(), labels.warnings.begin(), labels.warnings.end());
}

ObservationSource read_own(const MapInput& input, std::optional<Sensor> sensor) {
  return input.source ? read_observations(*input.source, sensor, input.layout, input.unit)
                      : read_observations(input.path, sensor, input.layout, input.unit);
}

DetectionSource read_detections_of(const MapInput& input, std::optional<Sensor> value) {
  const DetectionFormat format{.unit = input.unit, .value = value};
  return input.source ? read_detections(*input.source, format)
                      : read_detections(input.path, format);
}

}  // namespace

void open_observations(MapInput& input) {
  if (is_folder(input.path)) return;
  input.source = std::make_shared<ByteSource>(input.path);
  if (input.kind.empty() && input.layout == Layout::kAuto && is_detections(*input.source))
    input.kind = kRangeBearing;
}

MapResult map_input(const MapInput& input, const std::optional<NamedPointsFile>& anchors,
                    const std::optional<NamedPointsFile>& truth, const MapOptions& options) {
  const std::optional<Sensor> sensor = input.kind.empty() ? std::nullopt : sensor_named(input.kind);
  if (!input.others.empty()) {
    std::vector<ObservationSource> sources = {read_own(input, sensor)};
    for (const OtherInput& other : input.others)
      sources.push_back(
          read_observations(other.path, sensor_named(other.kind), input.layout, input.unit));
    for (const ObservationSource& source : sources)
      if (!source.unlabelled.empty())
        throw IoError(source.path, fmt::format("line {}", source.unlabelled.front().line),
                      "a reading without a label: not with --with");
    return map_mixed(sources, anchors, truth, options);
  }
  if (input.kind == kRangeBearing) {
    DetectionSource source = read_detections_of(input, std::nullopt);
    CheckedLabels labels = check_labels_of(source, input.labels, anchors, truth);
    MapResult map = map_pairs(std::move(source), anchors, truth, options, input.rigid);
    add_labels(std::move(labels), map);
    return map;
  }
  const bool as_usual = options.missing.way == MissingChoice().way && options.submaps == 0 &&
                        !input.labels.asked() && input.unsure.empty() && !options.choose &&
                        options.ellipse_replicates == 0;
  if (sensor && as_usual && input.layout != Layout::kWide && input.source &&
      is_large_long_table(*input.source))
    return map_sparse(read_detections_of(input, sensor), *sensor, anchors, truth, options);
  ObservationSource source = read_own(input, sensor);
  CheckedLabels labels = check_labels_of(source, input.labels, anchors, truth);
  const bool doubtful = !source.unlabelled.empty() || !input.unsure.empty();
  const EstimatedLabels estimated = estimate_labels(source, input.unsure);
  source.remarks.insert(source.remarks.end(), estimated.remarks.begin(), estimated.remarks.end());
  MapResult map = map_observations(source, anchors, truth, options);
  map.warnings.insert(map.warnings.begin(), estimated.warnings.begin(), estimated.warnings.end());
  if (doubtful) map.estimated = estimated;
  add_labels(std::move(labels), map);
  return map;
}

}  // namespace mapproof
