#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/observation_history.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// How far a sensor's distances agree between both halves of its steps: their correlation over all
/// pairs, stepped up to the full length (Spearman and Brown). In [0, 1); 0 with fewer than 4 steps,
/// or where a half is uninformative.
double reliability(const ObservationHistory& history, Eigen::Index steps);

/// Distances of several sensors in one: of each pair the weighted mean of the squared distances
/// that are finite, each sensor's in units of its own mean.
/// @param squared  Of each sensor, M x M.
/// @param weights  As many, >= 0, not all 0.
/// @return Squared distances; infinite where no sensor with a weight has one. The inner products
///         are those of the double-centred distances where all are finite, else 0.
/// @throws InvalidInput if sizes differ or a bound is broken.
Proximities mixed_proximities(const std::vector<Eigen::MatrixXd>& squared,
                              const std::vector<double>& weights);

/// Weights for that by reliability r: r / (1 - r), as of a signal and its noise; they sum to 1.
/// Equal ones if no sensor is informative.
std::vector<double> weights_of(const std::vector<double>& reliabilities);

}  // namespace mapproof
