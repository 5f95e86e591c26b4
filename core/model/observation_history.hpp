#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/sensor.hpp"

namespace mapproof {

/// What was observed of M landmarks over N steps by one kind of sensor [yairi2007, eqs. 3 and 5].
struct ObservationHistory {
  Sensor sensor = Sensor::kVisibility;
  std::vector<std::string> names;  ///< Of the landmarks, M of them, all different.
  Eigen::MatrixXd values;          ///< M x N: 0 or 1, rad, or m. NaN where nothing was observed.

  Eigen::Index landmarks() const { return values.rows(); }
  Eigen::Index steps() const { return values.cols(); }
};

}  // namespace mapproof
