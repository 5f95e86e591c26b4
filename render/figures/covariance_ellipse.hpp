#pragma once

#include <Eigen/Core>

namespace mapproof {

/// Half axes and turn of an ellipse.
struct CovarianceEllipse {
  double a = 0.0;  ///< a >= b, in the unit of the covariance's root.
  double b = 0.0;
  double turn_rad = 0.0;  ///< Of a from the x axis, counter-clockwise.
};

/// The ellipse about the mean that holds 95 % of a normal scatter with that covariance.
/// @param C  Symmetric; not positive semidefinite: the axis is 0 there.
CovarianceEllipse covariance_ellipse(const Eigen::Matrix2d& C);

}  // namespace mapproof
