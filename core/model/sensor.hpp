#pragma once

#include <optional>
#include <string_view>

namespace mapproof {

/// What the robot measures of each landmark at each step.
enum class Sensor {
  kVisibility,  ///< 1 if seen, 0 if not.
  kBearing,     ///< Direction relative to the heading, rad.
  kRange,       ///< Distance, m.
};

/// The name used in files and on the command line: "visibility", "bearing", "range".
std::string_view name(Sensor sensor);

/// The sensor of that name; empty if there is none.
std::optional<Sensor> sensor_named(std::string_view name);

}  // namespace mapproof
