#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// Readings of one landmark, with where dead reckoning puts the robot at them.
struct LandmarkReadings {
  Eigen::VectorXd time_s;   ///< R, ascending.
  Points positions_m;       ///< R x 2.
  Eigen::VectorXd range_m;  ///< R, >= 0.

  Eigen::Index size() const { return time_s.size(); }
  /// Those in some rows.
  LandmarkReadings at(const std::vector<Eigen::Index>& rows) const;
};

/// Squared range to one landmark around one stretch of a path, r^2 = a^2 |p - c|^2 + an affine
/// function of p: exact where dead reckoning is, whatever the landmark's place.
struct LocalRange {
  Eigen::RowVector2d center_m;   ///< c.
  double unit_m = 1.0;           ///< Spread of the positions about it.
  double squared_scale = 1.0;    ///< a^2.
  Eigen::Vector3d coefficients;  ///< On [1, (p - c) / unit], m^2.
  Eigen::Matrix3d covariance;    ///< Of the coefficients, up to the readings' variance.

  /// r^2 at a position, m^2.
  double squared_range(const Eigen::RowVector2d& position) const;
  /// Variance of that, up to the readings' variance.
  double variance(const Eigen::RowVector2d& position) const;
};

/// Robust fit to readings `first` to `first + count`: iterated Huber weights, 1.5 scaled medians of
/// the residuals, over 1 / r, since the error of r^2 grows with r.
/// @param range_scale  a: measured range over distance, > 0.
/// @param count  4 or more.
/// @throws InvalidInput if there are fewer.
/// @note O(count) time a round.
LocalRange fit_local_range(const LandmarkReadings& readings, Eigen::Index first, Eigen::Index count,
                           double range_scale);

/// What readings say about a^2 on their own: a weighted mean adds up.
struct ScaleEvidence {
  double squared_scale = 0.0;
  double weight = 0.0;  ///< Inverse variance, up to the readings' variance; 0: nothing.
};

/// The same fit with a^2 free. No weight where the positions are on a line or circle.
ScaleEvidence local_scale(const LandmarkReadings& readings, Eigen::Index first, Eigen::Index count);

}  // namespace mapproof
