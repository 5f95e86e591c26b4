#pragma once

#include <string>

#include "render/scene/scene.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// As figure_script() of a scene, by mpl_toolkits.mplot3d: one 3-D axes per view.
std::string scene_script(const Scene& scene, const Theme& theme);

}  // namespace mapproof
