#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"

namespace mapproof {

/// A world with its ranges, to hold a map against.
struct TrueRanges {
  Points landmarks_m;        ///< N x 2.
  Points positions_m;        ///< T x 2.
  Eigen::MatrixXd ranges_m;  ///< N x T, noisy.
  RangeNoise noise;          ///< Of the ranges.
};

struct ModelErrorOptions {
  Eigen::Index known = 4;          ///< The first so many landmarks are given: 4 to N.
  bool subtract_variances = true;  ///< By factorize_without_noise(); else the plain SVD, as the
                                   ///< paper says, whose error does not fall below a floor.
};

/// Errors of a map made from the first steps of a world [boots2013, figure 1B].
struct ModelError {
  Eigen::Index steps = 0;
  double observation = 0.0;  ///< Frobenius norm of C-hat - C.
  double landmarks_m = 0.0;  ///< Mean distance of landmarks from their places, known ones too.
  double positions_m = 0.0;  ///< Mean distance of positions, by localise(), from theirs.
  double condition = 1.0;  ///< Of the known landmarks (see map_from_known_landmarks()): where they
                           ///< happen to lie near a circle errors are great, and so their mean.
  double sine = 0.0;       ///< Of the largest canonical angle between U and C.
};

/// Maps the world from its first steps and the places of known landmarks, for each number of steps.
/// @param steps  Each 4 to T.
/// @return One error a number of steps, less those that no map came out of.
/// @throws InvalidInput if a bound is broken.
/// @note O(N^2) time a step.
std::vector<ModelError> model_errors(const TrueRanges& world, std::span<const Eigen::Index> steps,
                                     const ModelErrorOptions& options = {});

}  // namespace mapproof
