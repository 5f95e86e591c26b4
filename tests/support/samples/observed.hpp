#pragma once

#include <Eigen/Core>

#include "core/model/experiment.hpp"

namespace mapproof::test {

/// Distances of the observation vectors of simulated landmarks, those never seen left out, in a
/// room of the paper's density (50 landmarks in 2.5 x 2.5 m). The seed alone decides.
Eigen::MatrixXd observed_distances(int landmarks, Sensor sensor, int steps, std::uint64_t seed);

}  // namespace mapproof::test
