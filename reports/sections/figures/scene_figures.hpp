#pragma once

#include <vector>

#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// What a scan takes in, the room with the best map, its landmarks in the space of observations,
/// and each method's error over the floor, for each sensor; how the best map forms where there are
/// maps at several steps.
std::vector<Scene> study_scenes(FigureSource& source);

/// The scenes of maps that form, as animations.
std::vector<Film> study_films(FigureSource& source);

}  // namespace mapproof
