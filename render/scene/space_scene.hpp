#pragma once

#include <string>
#include <vector>

#include "core/model/slam/slam.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

struct SpaceSceneSpec {
  std::string id;
  std::string title;
  SpaceRun run;
  std::vector<std::string> record_ids;
};

/// Whether there is something to show: a record, landmarks and a path that are not all in one point
/// and nowhere beyond 1e8 m.
bool has_space_scene(const SpaceRun& run);

/// Landmarks in space, a view for each record: true positions over the ground, the true path as a
/// tube coloured by time with the estimated one beside it, and a rod from each true position to its
/// estimate, lengthened by a round factor that is said where it would be too short to be seen. A
/// record without a map shows the ground truth alone and a note gives the reason.
/// @throws InvalidInput without records, landmarks or positions, or if sizes disagree.
Scene space_scene(const SpaceSceneSpec& spec);

}  // namespace mapproof
