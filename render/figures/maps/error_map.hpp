#pragma once

#include <string>
#include <vector>

#include "render/figures/maps/map_grid.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct ErrorMapSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  double side_m = 0.0;          ///< Of the room, whose corner is the origin; > 0.
  std::vector<TitledMap> maps;  ///< In the frame of the ground truth.
};

/// The position error of each map over the floor, a panel per map with one scale of colours: each
/// cell has the mean of the landmarks' errors, weighted by the inverse cube of their distances
/// [shepard1968]. Dots are the landmarks, at their true positions.
/// @throws InvalidInput without a map, or where one has no ground truth or no finite error.
Figure error_map_figure(const ErrorMapSpec& spec);

}  // namespace mapproof
