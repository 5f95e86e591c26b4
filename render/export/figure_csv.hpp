#pragma once

#include <string>

#include "render/plot/figure.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

/// The data behind a figure as one table, one row per point, line, ellipse, cell or text: panel and
/// layer (counted from 1), its kind and label, its numbers in the units of the axes, and what its
/// mark tells (landmark, error, ...). Columns that no layer fills are left out. Figures and numbers
/// are the same each time.
std::string figure_csv(const Figure& figure);

/// The same of a scene: the points of its parts.
std::string scene_csv(const Scene& scene);

}  // namespace mapproof
