#include "core/linalg/planarity.hpp"

#include "core/linalg/decompositions.hpp"

namespace mapproof {

double planarity(const Points& points) {
  if (points.rows() < 3) return 0.0;
  const Points centered = points.rowwise() - points.colwise().mean();
  const Eigen::Vector2d values = Eigen::JacobiSVD<Points>(centered).singularValues();
  return values(0) > 0.0 ? values(1) / values(0) : 0.0;
}

}  // namespace mapproof
