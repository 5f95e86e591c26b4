#include "core/range_slam/factors/quadric.hpp"

#include <numbers>

#include "core/linalg/decompositions.hpp"

namespace mapproof {

Eigen::MatrixXd state_cone(Eigen::Index dimension) {
  Eigen::MatrixXd Q = Eigen::MatrixXd::Identity(dimension + 2, dimension + 2);
  Q(0, 0) = Q(dimension + 1, dimension + 1) = 0.0;
  Q(0, dimension + 1) = Q(dimension + 1, 0) = -1.0;
  return Q;
}

Eigen::MatrixXd quadratic_monomials(const Eigen::MatrixXd& V) {
  const Eigen::Index q = V.rows();
  Eigen::MatrixXd products(V.cols(), q * (q + 1) / 2);
  Eigen::Index column = 0;
  for (Eigen::Index i = 0; i < q; ++i)
    for (Eigen::Index j = i; j < q; ++j)
      products.col(column++) =
          (i == j ? 1.0 : std::numbers::sqrt2) * V.row(i).cwiseProduct(V.row(j)).transpose();
  return products;
}

Eigen::MatrixXd quadric_of(const Eigen::VectorXd& coefficients) {
  Eigen::Index q = 1;
  while (q * (q + 1) / 2 < coefficients.size()) ++q;
  Eigen::MatrixXd Q(q, q);
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < q; ++i)
    for (Eigen::Index j = i; j < q; ++j, ++k)
      Q(i, j) = Q(j, i) = coefficients(k) / (i == j ? 1.0 : std::numbers::sqrt2);
  return Q;
}

Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A) {
  if (A.rows() <= A.cols()) return A;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  return qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
}

}  // namespace mapproof
