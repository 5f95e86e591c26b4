#include "core/range_slam/factors/subspace.hpp"

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  if (qr.rank() < A.cols()) throw InvalidInput("a subspace needs independent columns");
  return leading_columns(qr.householderQ(), A.cols());
}

}  // namespace

Eigen::VectorXd canonical_angles(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  if (A.rows() != B.rows() || A.cols() != B.cols() || A.cols() < 1 || A.cols() > A.rows())
    throw InvalidInput("canonical angles need two subspaces of one dimension in one space");
  if (!A.allFinite() || !B.allFinite()) throw InvalidInput("a subspace needs finite columns");
  const Eigen::MatrixXd P = orthonormal(A), Q = orthonormal(B);
  const Eigen::MatrixXd common = P.transpose() * Q;
  const Eigen::VectorXd cosines = Eigen::JacobiSVD<Eigen::MatrixXd>(common).singularValues();
  const Eigen::VectorXd sines =
      Eigen::JacobiSVD<Eigen::MatrixXd>(Eigen::MatrixXd(Q - P * common)).singularValues().reverse();
  Eigen::VectorXd angles(A.cols());
  for (Eigen::Index i = 0; i < angles.size(); ++i)
    angles(i) = cosines(i) > std::numbers::sqrt2 / 2.0 ? std::asin(std::min(1.0, sines(i)))
                                                       : std::acos(std::min(1.0, cosines(i)));
  return angles;
}

double subspace_error_bound(Eigen::Index landmarks, Eigen::Index steps, double noise_constant,
                            double smallest_eigenvalue) {
  if (landmarks < 1 || steps < 2 || !(noise_constant >= 0.0) || !(smallest_eigenvalue > 0.0))
    throw InvalidInput("the bound needs landmarks, two steps, c >= 0 and gamma > 0");
  const double T = static_cast<double>(steps);
  return static_cast<double>(landmarks) * noise_constant * std::sqrt(2.0 * std::log(T) / T) /
         smallest_eigenvalue;
}

}  // namespace mapproof
