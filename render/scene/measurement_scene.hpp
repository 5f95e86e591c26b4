#pragma once

#include <string>

#include "core/model/measurement.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// One measurement in the room [yairi2007, figs. 2 and 3]. Visibility: the disc within reach, the
/// shadows on the floor, visible and hidden landmarks. Bearing: a ray to each landmark, three of
/// them named with their angle to the heading.
///
/// @param id  Of the scene, [a-z][a-z0-9-]*.
/// @throws InvalidInput as measurement_figure.
Scene measurement_scene(const Measurement& measurement, const std::string& id);

}  // namespace mapproof
