#include "render/figures/maps/covariance_ellipse.hpp"

namespace mapproof {

Ellipse covariance_ellipse(const Eigen::Matrix2d& C) {
  constexpr double kRoot_95 = 2.4477468306808166;  // Of -2 ln .05: chi-squared, 2 degrees.
  return ellipse_of(C, kRoot_95);
}

}  // namespace mapproof
