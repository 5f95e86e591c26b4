#include "core/range_slam/quadric.hpp"

#include <numbers>

#include <Eigen/QR>

namespace mapproof {

Eigen::Matrix4d state_cone() {
  Eigen::Matrix4d Q = Eigen::Matrix4d::Zero();
  Q(1, 1) = Q(2, 2) = 1.0;
  Q(0, 3) = Q(3, 0) = -1.0;
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

Eigen::Matrix4d quadric_of(const Eigen::VectorXd& coefficients) {
  Eigen::Matrix4d Q;
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < 4; ++i)
    for (Eigen::Index j = i; j < 4; ++j, ++k)
      Q(i, j) = Q(j, i) = coefficients(k) / (i == j ? 1.0 : std::numbers::sqrt2);
  return Q;
}

Eigen::MatrixXd triangle_of(const Eigen::MatrixXd& A) {
  if (A.rows() <= A.cols()) return A;
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(A);
  return qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>();
}

}  // namespace mapproof
