#pragma once

#include "core/base/random.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// A sensor of range and bearing.
struct DetectionSensor {
  double reach_m = 0.8;         ///< Landmarks farther away are not seen; > 0.
  double range_share = 0.02;    ///< Standard deviation of a range, as a share of it; >= 0.
  double bearing_rad = 0.0175;  ///< Of a bearing; >= 0.
};

/// A landmark that stands elsewhere from some step on.
struct SimulatedMove {
  Eigen::Index landmark = 0;
  Eigen::RowVector2d by_m = Eigen::RowVector2d::Zero();
  Eigen::Index from_step = 0;
};

/// What the sensor sees along a path, a scan a step; nothing hides anything.
DetectionLog simulated_detections(const World& world, const Path& path,
                                  const DetectionSensor& sensor, const SimulatedMove& move,
                                  Random& random);

}  // namespace mapproof
