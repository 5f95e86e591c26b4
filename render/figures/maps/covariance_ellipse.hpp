#pragma once

#include "core/model/map_uncertainty.hpp"

namespace mapproof {

/// The ellipse about the mean that holds 95 % of a normal scatter with that covariance.
/// @param C  Symmetric; not positive semidefinite: the axis is 0 there.
Ellipse covariance_ellipse(const Eigen::Matrix2d& C);

}  // namespace mapproof
