#pragma once

#include <cmath>

#include <Eigen/SVD>

#include "core/base/random.hpp"
#include "core/model/points.hpp"

namespace mapproof::test {

/// n points uniform in the square of half width `reach` about `center`.
inline Points points_about(Eigen::Index n, Random& random, double reach = 10.0,
                           const Eigen::RowVector2d& center = Eigen::RowVector2d::Zero()) {
  Points points(n, 2);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < 2; ++k) points(i, k) = center(k) + random.uniform(-reach, reach);
  return points;
}

/// Distances of landmarks (rows) to positions (columns).
inline Eigen::MatrixXd ranges_between(const Points& landmarks, const Points& positions) {
  Eigen::MatrixXd ranges(landmarks.rows(), positions.rows());
  for (Eigen::Index t = 0; t < positions.rows(); ++t)
    ranges.col(t) = (landmarks.rowwise() - positions.row(t)).rowwise().norm();
  return ranges;
}

/// One under the other.
inline Points stacked(const Points& above, const Points& below) {
  Points both(above.rows() + below.rows(), 2);
  both << above, below;
  return both;
}

/// Largest over least singular value of the columns, 1 for orthogonal ones of one length.
inline double condition_of(const Eigen::MatrixXd& columns) {
  const Eigen::VectorXd values =
      Eigen::JacobiSVD<Eigen::MatrixXd>(columns.colwise().normalized()).singularValues();
  return values(0) / values(values.size() - 1);
}

/// Points about their centre in units of their spread.
inline Points as_shape(const Points& points) {
  const Points offsets = points.rowwise() - points.colwise().mean();
  return offsets * std::sqrt(double(offsets.rows()) / offsets.squaredNorm());
}

/// How near points are to a line or circle: the condition of [1, x, y, x^2 + y^2].
inline double spread_of(const Points& points) {
  const Points p = as_shape(points);
  Eigen::MatrixXd columns(p.rows(), 4);
  columns << Eigen::VectorXd::Ones(p.rows()), p, p.rowwise().squaredNorm();
  return condition_of(columns);
}

/// How near points are to a curve of order four of which there are more than one on the states'
/// paraboloid: the condition of the products of [1, x, y, x^2 + y^2], less the one that is
/// dependent.
inline double conic_condition(const Points& points) {
  const Points p = as_shape(points);
  const Eigen::ArrayXd x = p.col(0), y = p.col(1), r = x.square() + y.square();
  Eigen::MatrixXd columns(p.rows(), 9);
  columns << Eigen::VectorXd::Ones(p.rows()), x, y, x * x, x * y, y * y, x * r, y * r, r * r;
  return condition_of(columns);
}

}  // namespace mapproof::test
