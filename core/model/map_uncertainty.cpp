#include "core/model/map_uncertainty.hpp"

#include <algorithm>
#include <cmath>

namespace mapproof {

Ellipse ellipse_of(const Eigen::Matrix2d& C, double radius) {
  // The eigenvalues of a symmetric 2 x 2 matrix in closed form.
  const double middle = (C(0, 0) + C(1, 1)) / 2.0;
  const double half = std::hypot((C(0, 0) - C(1, 1)) / 2.0, C(0, 1));
  return {.a = radius * std::sqrt(std::max(middle + half, 0.0)),
          .b = radius * std::sqrt(std::max(middle - half, 0.0)),
          .rotation_rad = 0.5 * std::atan2(2.0 * C(0, 1), C(0, 0) - C(1, 1))};
}

std::optional<Ellipse> confidence_ellipse(const MapUncertainty& uncertainty,
                                          Eigen::Index landmark) {
  const Eigen::Matrix2d& C = uncertainty.covariances.at(static_cast<std::size_t>(landmark));
  if (!C.allFinite()) return std::nullopt;
  return ellipse_of(C, std::sqrt(uncertainty.squared_radius));
}

bool covers(const MapUncertainty& uncertainty, Eigen::Index landmark,
            const Eigen::RowVector2d& position, const Eigen::RowVector2d& point) {
  const Eigen::Matrix2d& C = uncertainty.covariances.at(static_cast<std::size_t>(landmark));
  const Eigen::RowVector2d off = point - position;
  const Eigen::Matrix2d adjugate =
      (Eigen::Matrix2d() << C(1, 1), -C(0, 1), -C(1, 0), C(0, 0)).finished();
  const double determinant = C(0, 0) * C(1, 1) - C(0, 1) * C(1, 0);
  return C.allFinite() &&
         off * adjugate * off.transpose() <= uncertainty.squared_radius * determinant;
}

}  // namespace mapproof
