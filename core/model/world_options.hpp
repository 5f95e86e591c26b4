#pragma once

namespace mapproof {

/// How landmarks are scattered in the room.
struct WorldOptions {
  double side_m = 2.5;
  int landmarks = 50;
  double landmark_diameter_m = 0.048;
  double gap_m = 0.01;         ///< Least free space between two landmarks.
  double wall_margin_m = 0.1;  ///< Least free space between a landmark and a wall.
};

}  // namespace mapproof
