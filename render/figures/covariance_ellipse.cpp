#include "render/figures/covariance_ellipse.hpp"

#include <algorithm>
#include <cmath>

namespace mapproof {

CovarianceEllipse covariance_ellipse(const Eigen::Matrix2d& C) {
  constexpr double kRoot_95 = 2.4477468306808166;  // Of -2 ln .05: chi-squared, 2 degrees.
  // The eigenvalues of a symmetric 2 x 2 matrix in closed form.
  const double middle = (C(0, 0) + C(1, 1)) / 2.0;
  const double half = std::hypot((C(0, 0) - C(1, 1)) / 2.0, C(0, 1));
  return {kRoot_95 * std::sqrt(std::max(middle + half, 0.0)),
          kRoot_95 * std::sqrt(std::max(middle - half, 0.0)),
          0.5 * std::atan2(2.0 * C(0, 1), C(0, 0) - C(1, 1))};
}

}  // namespace mapproof
