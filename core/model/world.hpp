#pragma once

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// A square room [0, side] x [0, side] with cylindrical landmarks in it.
struct World {
  double side_m = 0.0;
  double landmark_diameter_m = 0.0;
  Points landmarks_m;  ///< M x 2, centres.
};

/// Where the robot was at each observation.
struct Path {
  Points positions_m;            ///< N x 2.
  Eigen::VectorXd headings_rad;  ///< N, counter-clockwise from the x axis, in (-pi, pi].
};

}  // namespace mapproof
