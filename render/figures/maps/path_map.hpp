#pragma once

#include <string>
#include <vector>

#include "core/model/slam/slam_study.hpp"
#include "render/plot/axis_map.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct PathMapSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  const SlamRun& run;
  std::vector<SlamMethod> methods;  ///< Shown in this order, the first lowest.
};

/// Paths and landmarks of a run, true and recovered: the map above and, where there is ground
/// ground truth, the error of each position over time below. Paths are thinned to what the eye can
/// see. Landmarks that carry a covariance have the ellipse of 95 %, enlarged by a stated factor
/// where it would be too small to be seen; a note counts those that the frame cuts. A path that
/// leaves the image, and a method without a path, is named.
/// @throws InvalidInput if parts of a record disagree in size.
/// @note Pure. O(T log T) a method.
Figure path_map_figure(const PathMapSpec& spec);

/// What a path map shows of its run.
struct PathView {
  std::vector<const SlamRecord*> shown;   ///< Those asked for that have a path or a landmark.
  std::vector<const SlamRecord*> failed;  ///< Those that have neither.
  PanelLimits limits;                     ///< Of the map.
  double side_m = 1.0;                    ///< The longer one of the image's sides.
  std::vector<std::string> leaving;       ///< Labels of methods whose path leaves the image.
  double tolerance_m = 0.0;               ///< Of thinning: a third of a pixel at 1200.
  double enlarged = 1.0;                  ///< Factor of the ellipses.

  /// Whether a position is within the limits; a missing one is not.
  bool shows(const Eigen::RowVector2d& at) const;
};

/// The image is where the ground truth is, or, without one, the bulk of the paths, and what lies
/// within half its side about it, with the ellipses of its landmarks (see with_ellipses()).
/// @throws InvalidInput if parts of a record disagree in size.
PathView path_view(const PathMapSpec& spec);

}  // namespace mapproof
