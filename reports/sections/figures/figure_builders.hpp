#pragma once

#include <span>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "render/scene/film.hpp"
#include "render/scene/scene.hpp"
#include "reports/sections/figures/figure_source.hpp"

namespace mapproof {

/// The register of the parts of study_figures(), each a pure function of the records. NAME_figures
/// is defined in NAME_figures.cpp, with its neighbours here. A figure that the records do not allow
/// is left out. Ids of paper figures are the experiment's; the others are made of what they show
/// and the sensor: "mpe-bearing-graph".

// measurement_figures.cpp: the paper's figures of one kind.
std::vector<Figure> idea_figures(FigureSource& source);
std::vector<Figure> measurement_figures(FigureSource& source);

/// Error over steps: the paper's, then MPE of the methods that they leave out, then MOE.
std::vector<Figure> curve_figures(FigureSource& source);

// map_figures.cpp
/// All methods on one run; the run nearest to the paper's example and the median run; then each
/// method's median run.
std::vector<Figure> map_figures(FigureSource& source);
/// A map forming over the steps, and what scatters between the runs of one layout.
std::vector<Figure> forming_figures(FigureSource& source);
/// "0.075 m off after 500 steps, 0.058 m after 2000", with that of a map between them that is worse
/// than both; empty where the first or the last has no score.
std::string errors_over_steps(std::span<const MapRecord> maps);

/// Error over the parameter of each method.
std::vector<Figure> parameter_figures(FigureSource& source);

// comparison_figures.cpp
/// Errors compared with the published ones; mean ranks, distances and eigenvalues of the methods.
std::vector<Figure> comparison_figures(FigureSource& source);
/// Error against seconds; varies from run to run.
std::vector<Figure> cost_figures(FigureSource& source, std::span<const Timing> timings);

/// What the experiment's variations show, and how often occlusion decided.
std::vector<Figure> condition_figures(FigureSource& source);

// scene_figures.cpp
/// What a scan takes in, the room with the best map, its landmarks in the space of observations,
/// and each method's error over the floor, for each sensor; how the best map forms where there are
/// maps at several steps.
std::vector<Scene> study_scenes(FigureSource& source);
/// The scenes of maps that form, as animations.
std::vector<Film> study_films(FigureSource& source);

}  // namespace mapproof
