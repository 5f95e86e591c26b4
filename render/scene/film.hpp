#pragma once

#include <string>
#include <vector>

#include "render/scene/scene.hpp"

namespace mapproof {

/// What an animation shows: one image after another, all of one size.
struct Film {
  std::string id;             ///< As a scene's.
  std::vector<Scene> frames;  ///< Of one view each.
};

}  // namespace mapproof
