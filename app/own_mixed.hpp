#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/own_reference.hpp"
#include "core/model/map_sensors.hpp"
#include "core/model/method.hpp"
#include "core/records/observations.hpp"
#include "render/plot/figure.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

struct OwnMap;
struct OwnMapOptions;

/// One map that a joint map is compared with, or itself.
struct ComparedMap {
  std::string what;         ///< "bearing alone", "joint map".
  MapRecord record;         ///< In the frame of the anchors, or laid on the joint map.
  double continuity = 0.0;  ///< Against all sensors' distances; NaN: not told.
  bool is_joint = false;
};

/// What a map of several sensors was made of.
struct OwnMixed {
  MapSensors sensors;
  std::vector<ComparedMap> maps;  ///< The joint map, then each sensor's own, then by order.
};

/// Maps what several kinds of sensor observed of the same landmarks into one (see mixed_map()).
///
/// Landmarks are matched by name; those that some files alone name are placed by the sensors that
/// have them, with a remark. Steps are not matched: each sensor's distances are over its own.
/// @param sources  Two or three, of different kinds; the first leads: its truth, if it has one.
/// @throws IoError naming the file if a kind is there twice, a file shares fewer than three
///         landmarks with those before it, or nothing was observed; else as map_own().
OwnMap map_mixed(const std::vector<ObservationSource>& sources,
                 const std::optional<NamedPointsFile>& anchors,
                 const std::optional<NamedPointsFile>& truth, const OwnMapOptions& options);

/// The joint map beside each sensor's own: weights, what speaks for which, errors where known.
Section mixed_section(const OwnMixed& mixed);

/// The same for --json.
nlohmann::ordered_json mixed_json(const OwnMixed& mixed);

/// The maps beside each other; empty if fewer than two came out.
std::optional<Figure> mixed_figure(const OwnMixed& mixed);

}  // namespace mapproof
