#pragma once

#include <Eigen/Core>

#include "core/model/observation_history.hpp"

namespace mapproof {

/// The vectors whose distances the mapping methods keep, one row per landmark, zero where missing.
struct Features {
  Eigen::MatrixXd values;  ///< M x C; C = steps, or 2 * steps for bearings (cosines, then sines).
  /// M x C: 1 where a value was observed, 0 elsewhere. Empty: everywhere.
  Eigen::MatrixXd observed;
};

/// @throws InvalidInput unless 1 <= steps <= history.steps().
void require_steps(const ObservationHistory& history, Eigen::Index steps);

/// Visibility: the 0/1 entries, normalised later pairwise-complete [yairi2007, eq. 7].
/// Bearing: unit direction vectors, not normalised [yairi2007, section 4.4.1].
/// Range: squared ranges less each landmark's mean over time, which are affine in its position.
///
/// @param steps  How many observations to use, 1 <= steps <= history.steps().
/// @throws InvalidInput if `steps` is out of bounds.
Features features(const ObservationHistory& history, Eigen::Index steps);

}  // namespace mapproof
