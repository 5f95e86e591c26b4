#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/map_record.hpp"
#include "core/model/points.hpp"
#include "core/model/world.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

struct MapSceneSpec {
  std::string id;
  std::string title;
  std::string where = {};   ///< Begins the caption, as "Layout 1, pose 2"; may be empty.
  std::string method = {};  ///< What made the map, in the caption; empty: method_label(map).
  MapRecord map;
  std::optional<World> world = {};  ///< The room; without one the ground is what the map covers.
  Points path_m = {};               ///< N x 2, in order; may be empty.
  /// M, of the landmarks' confidence ellipses, the longer one; what colours landmarks where no
  /// error is known. May be empty; NaN: not known.
  std::vector<double> half_axes = {};
};

/// The most landmarks of a map in space: of 500, pillars hide each other, and their light takes 2
/// s.
inline constexpr Eigen::Index kMostPillars = 200;

/// Whether the map can be drawn in space: it has kMostPillars landmarks at most, three of them or
/// more are mapped, at lengths that can be drawn, and they do not lie on one point.
bool has_map_scene(const MapRecord& map);

/// A map on its ground: pillars at the true positions of its landmarks or, where there are none, at
/// the estimated ones, anchors apart; the robot's path as a tube, its last steps; and an arrow on
/// the floor from each true to its estimated position. Landmarks are coloured by their error, or by
/// their ellipse. In a room they have their true diameter. Estimates more than .75 sides outside
/// the ground have no arrow; a note counts them. The worst three landmarks and the anchors are
/// named.
/// @throws InvalidInput if the map's landmarks are not as many as the world's, lengths are not
///         positive and finite, or there is no world and has_map_scene() is false.
Scene map_scene(const MapSceneSpec& spec);

}  // namespace mapproof
