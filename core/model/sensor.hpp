#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// The share of one of several sensors in a joint map.
struct SensorShare {
  Sensor sensor = Sensor::kVisibility;
  double reliability = 0.0;  ///< In [0, 1]: how far its distances from both halves of its steps are
                             ///< the same.
  double weight = 0.0;       ///< In the mean distances that the joint map starts from; sum 1.
  double share = 0.0;        ///< In the weights of all pairs of the joint map; sum 1.
  double continuity = 0.0;  ///< Of its own map against all sensors' distances; NaN: not determined.

  bool operator==(const SensorShare&) const = default;
};

/// The sensors of a joint map.
struct MapSensors {
  std::vector<SensorShare> sensors;
  double continuity = 0.0;  ///< Of the joint map against all sensors' distances; NaN: not
                            ///< determined.
};

/// Unit of the bearings of a file. They are relative to the heading, counter-clockwise.
enum class AngleUnit { kRadians, kDegrees };

}  // namespace mapproof
