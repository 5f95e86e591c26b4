#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/observation_history.hpp"
#include "core/model/points.hpp"
#include "core/model/study.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

struct ManifoldSceneSpec {
  std::string id;
  std::string title;
  std::string caption;
  ObservationManifold manifold;
  Points ground_truth_m;  ///< M x 2.
  double side_m = 0.0;    ///< Of the room.
  std::vector<std::string> record_ids;
};

/// Whether at least two landmarks have coordinates.
bool has_manifold_scene(const ObservationManifold& manifold);

/// Landmarks at the first three principal coordinates of their observations, with the neighbour
/// graph, coloured by true x and, beside it, by true y: where both run along the surface without
/// folds, a map of two dimensions can come out.
/// @throws InvalidInput if sizes disagree, an edge has no landmark, or fewer than two landmarks
///         have coordinates.
Scene manifold_scene(const ManifoldSceneSpec& spec);

/// One measurement in the room [yairi2007, figs. 2 and 3]. Visibility: the disc within reach, the
/// shadows on the floor, visible and hidden landmarks. Bearing: a ray to each landmark, three of
/// them named with their angle to the heading.
///
/// @param id  Of the scene, [a-z][a-z0-9-]*.
/// @throws InvalidInput as measurement_figure.
Scene measurement_scene(const Measurement& measurement, const std::string& id);

}  // namespace mapproof
