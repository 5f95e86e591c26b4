#pragma once

#include <string>

#include <Eigen/Core>

#include "core/model/map_record.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/study.hpp"
#include "core/model/world.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

struct IdeaSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  World world;
  Points path_m;               ///< N x 2, the whole walk or its first steps.
  ObservationHistory history;  ///< M x any number of steps.
  MapRecord map;               ///< Of M landmarks.
  int steps = 100;             ///< Of path and history that are shown; fewer if there are fewer.
};

/// The idea in three panels [yairi2007, fig. 1]: the room with the robot's path, the observation
/// history that it gives, landmark by step, and the map made of it.
/// @throws InvalidInput if parts disagree in size, steps < 1 or > 2000, or a position is not
/// finite.
Figure idea_figure(const IdeaSpec& spec);

/// One measurement in the room, landmarks at their true size [yairi2007, figs. 2 and 3].
///
/// Visibility: the disc within reach, what stands in it visible or hidden, and the shadows that
/// the landmarks cast, each between the two tangents from the robot. Bearing: the rays to all
/// landmarks, three of their angles to the heading drawn and named.
///
/// @param id  Of the figure, [a-z][a-z0-9-]*.
/// @throws InvalidInput if parts disagree in size, lengths are not positive, positions are not
/// finite,
///         or the sensor is neither.
Figure measurement_figure(const Measurement& measurement, const std::string& id);

}  // namespace mapproof
