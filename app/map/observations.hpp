#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/map/data_association_check.hpp"
#include "app/map/one_sensor.hpp"
#include "core/base/byte_source.hpp"

namespace mapproof {

/// Observations by another sensor of the same landmarks.
struct OtherInput {
  std::string path;
  std::string kind;  ///< A sensor's name.
};

/// A person's observations as the command line names them.
struct MapInput {
  std::string path;
  std::shared_ptr<ByteSource> source = {};  ///< Opened; none: the path is a folder.
  std::string kind;  ///< A sensor's name, kRangeBearing, or empty: as the file says.
  Layout layout = Layout::kAuto;
  AngleUnit unit = AngleUnit::kRadians;
  bool rigid = false;  ///< Fit a metric map to the anchors without changing its scale.
  LabelChoice labels;  ///< Of range and bearing seen together.
  std::vector<std::string> unsure = {};  ///< Labels that are confused with one another.
  std::vector<OtherInput> others = {};   ///< To be mapped together with it.
};

/// Opens the input, and looks into it for its kind where that was not given: range-bearing of
/// detections. @throws IoError if it cannot be read.
void open_observations(MapInput& input);

/// Reads and maps observations that were opened, by options.setting or, of range and
/// bearing, by pairs. Long tables of more than some 64 MB are never held as an array of landmarks
/// times steps. With others, one map of all (see map_mixed()).
/// @throws IoError as the readers and map_observations().
MapResult map_input(const MapInput& input, const std::optional<NamedPointsFile>& anchors,
                    const std::optional<NamedPointsFile>& truth, const MapOptions& options);

}  // namespace mapproof
