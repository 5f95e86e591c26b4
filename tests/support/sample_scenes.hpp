#pragma once

#include <vector>

#include "render/scene/scene.hpp"

namespace mapproof::test {

/// One part of each kind, translucent ones among them, seen in perspective and from above; with
/// labels, axes and lights.
Scene small_scene();

/// Every kind of scene, with tame data and with data that is hard to draw. Ids tell which.
std::vector<Scene> sample_scenes();

}  // namespace mapproof::test
