#pragma once

#include <vector>

#include "core/model/slam/slam.hpp"
#include "core/model/slam/slam_study.hpp"
#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"

namespace mapproof::test {

/// One part of each kind, translucent ones among them, seen in perspective and from above; with
/// labels, axes and lights.
Scene small_scene();

/// Every kind of scene, with tame data and with data that is hard to draw. Ids tell which.
std::vector<Scene> sample_scenes();

/// States of a path before and after a metric upgrade, off the paraboloid by so much.
UpgradeClouds sample_clouds(double noise);

/// Ten landmarks and a winding flight, with a record of either kind.
SpaceRun sample_space_run();

/// Ten frames.
Film sample_film();

}  // namespace mapproof::test
