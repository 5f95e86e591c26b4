#pragma once

#include <string>

#include "core/model/measurement.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// One measurement in the room, landmarks at their true size [yairi2007, figs. 2 and 3].
///
/// Visibility: the disc within reach, what stands in it visible or hidden, and the shadows that
/// the landmarks cast, each between the two tangents from the robot. Bearing: the rays to all
/// landmarks, three of their angles to the heading drawn and named.
///
/// @param id  Of the figure, [a-z][a-z0-9-]*.
/// @throws InvalidInput if parts disagree in size, lengths are not positive, places are not finite,
///         or the sensor is neither.
Figure measurement_figure(const Measurement& measurement, const std::string& id);

}  // namespace mapproof
