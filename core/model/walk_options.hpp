#pragma once

namespace mapproof {

/// The robot's random walk [yairi2007, section 4.1].
struct WalkOptions {
  double step_m = 0.2;
  double heading_change_rad = 0.78539816339744831;  ///< The new direction is uniform in +- this.
  double substep_m = 0.01;
  double clearance_m = 0.02;    ///< Least distance of the robot's centre to a landmark's surface.
  double wall_margin_m = 0.06;  ///< Least distance of the robot's centre to a wall.
};

}  // namespace mapproof
