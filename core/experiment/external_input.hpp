#pragma once

#include <cstdint>
#include <string>

#include "core/model/experiment.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/study.hpp"

namespace mapproof {

/// What a method of others gets of the first observations: one row per landmark.
/// @param steps  1 <= steps <= history.steps().
Eigen::MatrixXd external_input(const ObservationHistory& history, int steps, ExternalInput input);

/// "layout-1-pose-1/bearing/2000": of what a map is made.
std::string checkpoint_id(const RunId& run, Sensor sensor, int steps);

/// Of that checkpoint alone, below 2^53.
std::uint64_t checkpoint_seed(std::uint64_t seed, const RunId& run, Sensor sensor, int steps);

}  // namespace mapproof
