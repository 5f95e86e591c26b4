#pragma once

#include <Eigen/Core>

#include "core/base/random.hpp"

namespace mapproof {

/// How simulated ranges err.
struct SimulatedRangeNoise {
  double sigma_m = 0.0;      ///< Standard deviation of a range, m, >= 0.
  double share = 0.0;        ///< The same as a share of the range, >= 0; both add as variances.
  double correlation = 0.0;  ///< Of errors to one landmark one step apart, in [0, 1).
};

/// Ranges of landmarks at positions, with noise, none below 0.
/// @param landmarks_m  N x d.
/// @param positions_m  T x d.
/// @return N x T.
/// @throws InvalidInput if a bound of the noise is broken, or dimensions disagree.
Eigen::MatrixXd simulated_ranges(const Eigen::MatrixXd& landmarks_m,
                                 const Eigen::MatrixXd& positions_m,
                                 const SimulatedRangeNoise& noise, Random& random);

}  // namespace mapproof
