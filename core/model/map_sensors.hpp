#pragma once

#include <string>
#include <vector>

#include "core/model/sensor.hpp"

namespace mapproof {

/// What one of several sensors had to say in a joint map.
struct SensorShare {
  Sensor sensor = Sensor::kVisibility;
  double reliability = 0.0;  ///< In [0, 1]: how far its distances from both halves of its steps are
                             ///< the same.
  double weight = 0.0;       ///< In the mean distances that the joint map starts from; sum 1.
  double share = 0.0;        ///< In the weights of all pairs of the joint map; sum 1.
  double continuity = 0.0;   ///< Of its own map against all sensors' distances; NaN: not told.

  bool operator==(const SensorShare&) const = default;
};

/// The sensors of a joint map.
struct MapSensors {
  std::vector<SensorShare> sensors;
  double continuity = 0.0;  ///< Of the joint map against all sensors' distances; NaN: not told.
  std::string why;          ///< Where the weights come from, and which map they speak for.
};

}  // namespace mapproof
