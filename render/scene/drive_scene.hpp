#pragma once

#include <string>
#include <vector>

#include "core/model/slam/slam_study.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

struct DriveSceneSpec {
  std::string id;
  std::string title;
  const SlamRun& run;
  SlamMethod method = SlamMethod::kRefined;  ///< Whose path and landmarks are shown.
  std::vector<std::string> record_ids = {};
};

/// Whether a method of the run has a path of two positions, within lengths that can be drawn.
bool has_drive_scene(const SlamRun& run, SlamMethod method);

/// A recorded drive seen from above: the ground with the path of a method, coloured by its error
/// or, without ground truth, by time; under it the true path, wide and grey, and dead reckoning.
/// Landmarks are pillars at their true positions; where there is no ground truth, at the estimated
/// ones. A ball is where the method has each.
/// The ground is what path_view() shows; what lies outside is left out, and a note names it. Paths
/// are thinned to what can be seen.
/// @throws InvalidInput unless has_drive_scene(), or if parts of a record disagree in size.
/// @note Pure. O(T).
Scene drive_scene(const DriveSceneSpec& spec);

}  // namespace mapproof
