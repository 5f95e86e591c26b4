#pragma once

#include <string>
#include <vector>

#include "core/model/slam_study.hpp"
#include "render/figures/maps/path_map.hpp"
#include "render/plot/axis_map.hpp"

namespace mapproof {

/// What a path map shows of its run.
struct PathView {
  std::vector<const SlamRecord*> shown;   ///< Those asked for that have a path or a landmark.
  std::vector<const SlamRecord*> failed;  ///< Those that have neither.
  PanelLimits limits;                     ///< Of the map.
  double side_m = 1.0;                    ///< The longer one of the picture's sides.
  std::vector<std::string> leaving;       ///< Labels of methods whose path leaves the picture.
  double tolerance_m = 0.0;               ///< Of thinning: a third of a pixel at 1200.
  double enlarged = 1.0;                  ///< Factor of the ellipses.
};

/// The picture is where the truth is, or, without one, the bulk of the paths, and what lies within
/// half its side about it.
/// @throws InvalidInput if parts of a record disagree in size.
PathView path_view(const PathMapSpec& spec);

}  // namespace mapproof
