#pragma once

#include <span>

#include <Eigen/Core>

#include "core/model/histories/history_blocks.hpp"
#include "core/model/observation_history.hpp"

namespace mapproof {

/// The vectors whose distances the mapping methods keep, one row per landmark, zero where missing.
struct Features {
  Eigen::MatrixXd values;  ///< M x C; C = steps, or 2 * steps for bearings (cosines, then sines).
  /// M x C: 1 where a value was observed, 0 elsewhere. Empty: everywhere.
  Eigen::MatrixXd observed;
};

/// @throws InvalidInput unless 1 <= steps <= history.steps().
void require_steps(const HistoryBlocks& history, Eigen::Index steps);

/// Visibility: the 0/1 entries, normalised later pairwise-complete [yairi2007, eq. 7].
/// Bearing: unit direction vectors, not normalised [yairi2007, section 4.4.1].
/// Range: squared ranges less each landmark's mean over time, which are affine in its position.
///
/// @param steps  How many observations to use, 1 <= steps <= history.steps().
/// @throws InvalidInput if `steps` is out of bounds.
Features features(const ObservationHistory& history, Eigen::Index steps);

/// The vectors of some steps, whose inner products add up over the steps.
/// @param values  M x count, as ObservationHistory has them.
/// @param mean_squares  Of ranges: M, mean_squared_ranges() over all steps; else not read.
Features features_of(const Eigen::MatrixXd& values, Sensor sensor,
                     const Eigen::VectorXd& mean_squares);

/// The unit vectors of complete bearings, as features_of() has them but for the last bit: see
/// directions_of().
Features directions(const Eigen::MatrixXd& bearings_rad);

/// Each landmark's mean squared range over the first `steps` observations in which it was measured.
Eigen::VectorXd mean_squared_ranges(const HistoryBlocks& history, Eigen::Index steps);

/// The cosines and sines of angles, to 2e-16: some ten times as fast as one after the other.
/// Same bits whatever vectors the processor has; not those of libm, which may differ in the last
/// one.
/// @param angles_rad      Finite, |rad| <= 1e5; NaN gives NaN.
/// @param cosines, sines  As many; none of them overlap.
void directions_of(std::span<const double> angles_rad, std::span<double> cosines,
                   std::span<double> sines);

}  // namespace mapproof
