#pragma once

#include <Eigen/Core>

#include "core/model/observation_history.hpp"

namespace mapproof {

/// How many consecutive values a circular block bootstrap should draw together, so that it
/// estimates the variance of the series' mean with the least squared error [politis2004]
/// [patton2009].
///
/// @param series  Finite.
/// @return At least 1, at most min(3 sqrt(n), n / 3) rounded up; 1 for a series without variance.
/// @note O(n^1.5) time.
double best_block_length(const Eigen::VectorXd& series);

/// The usual length for a map: the mean of the best lengths over the contributions of single steps
/// to the distances between landmarks, of some 60 pairs spread evenly over all.
///
/// @param steps  How many observations to use, 1 <= steps <= history.steps().
/// @return 1 to (steps + 2) / 3.
/// @throws InvalidInput if `steps` is out of bounds.
Eigen::Index map_block_length(const ObservationHistory& history, Eigen::Index steps);

}  // namespace mapproof
