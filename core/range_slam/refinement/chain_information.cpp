#include "core/range_slam/refinement/chain_information.hpp"

#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

/// A factor's pivots below this share of the matrix's diagonal are rounding.
constexpr double kLeastPivot = 1e-13;

/// L of A = L L'; empty where a pivot is no more than rounding of `diagonal`.
template <typename Matrix>
std::optional<Matrix> factor(const Matrix& A, const Eigen::VectorXd& diagonal) {
  if (A.rows() == 0) return A;
  const Eigen::LLT<Matrix> llt(A);
  if (llt.info() != Eigen::Success) return std::nullopt;
  const Matrix L = llt.matrixL();
  const Eigen::ArrayXd pivots = L.diagonal().array().square();
  if (!(pivots > kLeastPivot * diagonal.array()).all()) return std::nullopt;
  return L;
}

template <typename Matrix>
Matrix inverse_of(const Matrix& L) {
  if (L.rows() == 0) return L;
  const Matrix inverse =
      L.template triangularView<Eigen::Lower>().solve(Matrix::Identity(L.rows(), L.cols()));
  return inverse.transpose() * inverse;
}

}  // namespace

ChainInformation::ChainInformation(Eigen::Index poses, Eigen::Index shared)
    : D_(static_cast<std::size_t>(poses), Eigen::Matrix3d::Zero()),
      O_(static_cast<std::size_t>(poses), Eigen::Matrix3d::Zero()),
      B_(static_cast<std::size_t>(poses), Eigen::MatrixXd::Zero(shared, 3)),
      C_(Eigen::MatrixXd::Zero(shared, shared)) {}

void ChainInformation::add(Eigen::Index i, const Eigen::MatrixXd& J_first,
                           const Eigen::MatrixXd& J_second,
                           const std::vector<Eigen::Index>& columns,
                           const Eigen::MatrixXd& J_shared) {
  const auto first = static_cast<std::size_t>(i);
  const auto second = static_cast<std::size_t>(i + 1);
  const bool has_first = i >= 0;
  const bool has_second = J_second.size() > 0;
  if (has_first) D_[first] += J_first.transpose() * J_first;
  if (has_second) D_[second] += J_second.transpose() * J_second;
  if (has_first && has_second) O_[first] += J_second.transpose() * J_first;
  for (std::size_t a = 0; a < columns.size(); ++a) {
    const Eigen::RowVectorXd column = J_shared.col(static_cast<Eigen::Index>(a)).transpose();
    if (has_first) B_[first].row(columns[a]) += column * J_first;
    if (has_second) B_[second].row(columns[a]) += column * J_second;
    for (std::size_t b = 0; b < columns.size(); ++b)
      C_(columns[a], columns[b]) += column.dot(J_shared.col(static_cast<Eigen::Index>(b)));
  }
}

std::optional<ChainInformation::Covariance> ChainInformation::inverse() const {
  const std::size_t poses = D_.size();
  // Elimination from the first pose on: S_i is what is left of D_i, G_i = O_i S_i^-1 carries it on,
  // and R_i is what is left of B_i.
  std::vector<Eigen::Matrix3d> S_inverse(poses);
  std::vector<Eigen::MatrixXd> R = B_;
  Eigen::MatrixXd C = C_;
  Eigen::Matrix3d S = D_[0];
  for (std::size_t i = 0; i < poses; ++i) {
    const auto L = factor<Eigen::Matrix3d>(S, D_[i].diagonal());
    if (!L) return std::nullopt;
    S_inverse[i] = inverse_of(*L);
    C -= R[i] * S_inverse[i] * R[i].transpose();
    if (i + 1 == poses) break;
    const Eigen::Matrix3d G = O_[i] * S_inverse[i];
    S = D_[i + 1] - G * O_[i].transpose();
    R[i + 1] -= R[i] * G.transpose();
  }
  const auto L = factor<Eigen::MatrixXd>(C, C_.diagonal());
  if (!L) return std::nullopt;

  // Back: of each pose the inverse's block, and that towards the shared numbers.
  Covariance covariance{.shared = inverse_of(*L),
                        .poses = std::vector<Eigen::Matrix3d>(poses),
                        .shared_pose = std::vector<Eigen::MatrixXd>(poses)};
  Eigen::Matrix3d next = Eigen::Matrix3d::Zero();
  Eigen::MatrixXd next_shared = Eigen::MatrixXd::Zero(C.rows(), 3);
  for (std::size_t i = poses; i-- > 0;) {
    // x_i depends on what comes after it by x_i = -S_i^-1 (O_i' x_{i+1} + R_i' shared) + noise.
    const Eigen::Matrix3d A = -S_inverse[i] * O_[i].transpose();
    const Eigen::MatrixXd E = -S_inverse[i] * R[i].transpose();
    const Eigen::Matrix3d cross = A * next_shared.transpose() * E.transpose();
    covariance.shared_pose[i] = next_shared * A.transpose() + covariance.shared * E.transpose();
    covariance.poses[i] = S_inverse[i] + A * next * A.transpose() +
                          E * covariance.shared * E.transpose() + cross + cross.transpose();
    next = covariance.poses[i];
    next_shared = covariance.shared_pose[i];
  }
  return covariance;
}

}  // namespace mapproof
