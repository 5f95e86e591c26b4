#pragma once

#include <vector>

#include "render/figures/curves/error_curve.hpp"
#include "render/figures/curves/level_curve.hpp"
#include "render/figures/curves/spectrum.hpp"
#include "render/figures/diagrams/heat_map.hpp"
#include "render/figures/diagrams/measurement.hpp"
#include "render/figures/diagrams/method_comparison.hpp"
#include "render/figures/diagrams/shepard.hpp"
#include "render/figures/maps/map_grid.hpp"
#include "render/figures/maps/scatter_map.hpp"

namespace mapproof::test {

/// The first `count` of ten labels of methods, short ones.
std::vector<std::string> method_labels(std::size_t count);

CriticalDifferenceSpec sample_ranks(std::size_t methods);
EllipseMapSpec sample_runs(int landmarks, int runs);
ShepardSpec sample_distances(std::size_t methods, int landmarks);
SpectrumSpec sample_spectra(std::size_t methods);
MapGridSpec sample_maps(std::size_t count);
AnchorCountSpec sample_anchor_counts();
LevelCurveSpec sample_levels(std::size_t methods);
HeatMapSpec sample_heat(std::size_t columns, std::size_t rows);
ParetoSpec sample_costs(std::size_t settings);
IdeaSpec sample_idea(Sensor sensor);

/// The figures that compare methods and runs, with tame data and with data that is hard to draw.
std::vector<Figure> sample_comparison_figures();

}  // namespace mapproof::test
