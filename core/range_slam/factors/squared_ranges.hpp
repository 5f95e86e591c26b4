#pragma once

#include <Eigen/Core>

namespace mapproof {

/// Standard deviation of one range measurement at distance d: the root of sigma_m^2 + (share d)^2.
struct RangeNoise {
  double sigma_m = 0.0;  ///< >= 0.
  double share = 0.0;    ///< Of the distance, >= 0.
};

/// Y = 1/2 d^2 [boots2013, eq. 1], less what noise adds: E[r^2] = (1 + share^2) d^2 + sigma^2.
/// @param ranges_m  N x T, finite: rows landmarks, columns times.
/// @return N x T, m^2; short ranges under much noise may come out below 0.
/// @throws InvalidInput if a bound is broken, or a square overflows.
Eigen::MatrixXd half_squared_ranges(const Eigen::MatrixXd& ranges_m, const RangeNoise& noise = {});

/// What that noise has for a variance in each row of Y, on average over its columns: of 1/2 r^2 it
/// is d^2 s^2 + s^4/2 for a normal error of standard deviation s.
/// @param Y  From half_squared_ranges() with the same noise.
/// @return N, m^4.
Eigen::VectorXd half_square_variances(const Eigen::MatrixXd& Y, const RangeNoise& noise);

/// C with the rows [|m|^2/2, m, 1] [boots2013, eq. 3], which holds in space as in the plane.
/// @param landmarks_m  N x d.
/// @return N x (d + 2).
Eigen::MatrixXd landmark_states(const Eigen::MatrixXd& landmarks_m);

/// X with the columns [1, -p, |p|^2/2] [boots2013, eq. 3], so that Y = C X.
/// @param positions_m  T x d.
/// @return (d + 2) x T.
Eigen::MatrixXd robot_states(const Eigen::MatrixXd& positions_m);

}  // namespace mapproof
