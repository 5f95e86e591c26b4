#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/map/reference.hpp"
#include "core/model/method.hpp"
#include "core/model/sensor.hpp"
#include "core/records/observations/observations.hpp"

namespace mapproof {

struct MapResult;
struct MapOptions;

/// One map that a joint map is compared with, or itself.
struct ComparedMap {
  std::string what;         ///< "bearing alone", "joint map".
  MapRecord record;         ///< In the frame of the anchors, or aligned to the joint map.
  double continuity = 0.0;  ///< Against all sensors' distances; NaN: not told.
  bool is_joint = false;

  /// In the anchors' frame, or else with the affine map fitted to all; NaN without a truth.
  double mpe_m() const;
};

/// What a map of several sensors was made of.
struct JointMapResult {
  MapSensors sensors;
  std::vector<ComparedMap> maps;  ///< The joint map, then each sensor's own, then by order.
};

/// Maps what several kinds of sensor observed of the same landmarks into one (see mixed_map()).
///
/// Landmarks are matched by name; those that some files alone name are placed by the sensors that
/// have them, with a remark. Steps are not matched: each sensor's distances are over its own.
/// @param sources  Two or three, of different kinds; the first leads: its truth, if it has one.
/// @throws IoError naming the file if a kind is there twice, a file shares fewer than three
///         landmarks with those before it, or nothing was observed; else as map_observations().
MapResult map_mixed(const std::vector<ObservationSource>& sources,
                    const std::optional<NamedPointsFile>& anchors,
                    const std::optional<NamedPointsFile>& truth, const MapOptions& options);

}  // namespace mapproof
