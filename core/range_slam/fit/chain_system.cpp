#include "core/range_slam/fit/chain_system.hpp"

#include <cmath>

#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

/// A pivot below this share of the matrix's diagonal is rounding.
constexpr double kLeastChainPivot = 1e-13;

/// The inverse of a symmetric matrix and the logarithm of its determinant; false if it is not
/// positive definite to the precision of `diagonal`.
bool invert(const Eigen::Matrix3d& A, const Eigen::Vector3d& diagonal, Eigen::Matrix3d& inverse,
            double& log_determinant) {
  const Eigen::LLT<Eigen::Matrix3d> llt(A);
  if (llt.info() != Eigen::Success) return false;
  const Eigen::Matrix3d L = llt.matrixL();
  const Eigen::Array3d pivots = L.diagonal().array().square();
  if (!(pivots > kLeastChainPivot * diagonal.array()).all()) return false;
  log_determinant += pivots.log().sum();
  const Eigen::Matrix3d L_inverse =
      L.triangularView<Eigen::Lower>().solve(Eigen::Matrix3d::Identity());
  inverse.noalias() = L_inverse.transpose() * L_inverse;
  return true;
}

}  // namespace

/// Elimination from the first pose on: S_i is what is left of D_i, R_i of B_i.
struct ChainSystem::Factors {
  std::vector<Eigen::Matrix3d> S_inverse;
  Eigen::MatrixXd R;  ///< m x 3K.
  Eigen::MatrixXd C;
  Eigen::VectorXd g_poses;
  Eigen::VectorXd g_shared;
  double log_determinant = 0.0;
};

ChainSystem::ChainSystem(Eigen::Index poses, Eigen::Index shared)
    : poses_(poses),
      shared_(shared),
      D_(static_cast<std::size_t>(poses)),
      O_(static_cast<std::size_t>(poses)),
      B_(shared, 3 * poses),
      C_(shared, shared),
      g_poses_(3 * poses),
      g_shared_(shared) {
  clear();
}

void ChainSystem::clear() {
  for (Eigen::Matrix3d& block : D_) block.setZero();
  for (Eigen::Matrix3d& block : O_) block.setZero();
  B_.setZero();
  C_.setZero();
  g_poses_.setZero();
  g_shared_.setZero();
}

void ChainSystem::add_motion(Eigen::Index i, const Eigen::Matrix3d& J_first,
                             const Eigen::Matrix3d& J_second, const Eigen::Vector3d& residual) {
  const auto second = static_cast<std::size_t>(i + 1);
  D_[second].noalias() += J_second.transpose() * J_second;
  g_poses_.segment<3>(3 * (i + 1)).noalias() -= J_second.transpose() * residual;
  if (i < 0) return;
  const auto first = static_cast<std::size_t>(i);
  D_[first].noalias() += J_first.transpose() * J_first;
  O_[first].noalias() += J_second.transpose() * J_first;
  g_poses_.segment<3>(3 * i).noalias() -= J_first.transpose() * residual;
}

void ChainSystem::add_range(Eigen::Index i, const Eigen::RowVector3d& J_first,
                            const Eigen::RowVector3d& J_second, const std::vector<Slope>& slopes,
                            double residual) {
  const auto second = static_cast<std::size_t>(i + 1);
  D_[second].noalias() += J_second.transpose() * J_second;
  g_poses_.segment<3>(3 * (i + 1)) -= J_second.transpose() * residual;
  if (i >= 0) {
    const auto first = static_cast<std::size_t>(i);
    D_[first].noalias() += J_first.transpose() * J_first;
    O_[first].noalias() += J_second.transpose() * J_first;
    g_poses_.segment<3>(3 * i) -= J_first.transpose() * residual;
  }
  for (const Slope& a : slopes) {
    if (i >= 0) B_.block<1, 3>(a.column, 3 * i) += a.value * J_first;
    B_.block<1, 3>(a.column, 3 * (i + 1)) += a.value * J_second;
    g_shared_(a.column) -= a.value * residual;
    for (const Slope& b : slopes) C_(a.column, b.column) += a.value * b.value;
  }
}

void ChainSystem::add_prior(Eigen::Index column, double slope, double residual) {
  C_(column, column) += slope * slope;
  g_shared_(column) -= slope * residual;
}

std::optional<ChainSystem::Factors> ChainSystem::factors(double damping) const {
  Factors f{.S_inverse = std::vector<Eigen::Matrix3d>(D_.size()),
            .R = B_,
            .C = C_,
            .g_poses = g_poses_,
            .g_shared = g_shared_};
  f.C.diagonal() *= 1.0 + damping;
  Eigen::Matrix3d S = D_[0];
  S.diagonal() *= 1.0 + damping;
  Eigen::MatrixXd RS(shared_, 3);
  for (Eigen::Index i = 0; i < poses_; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (!invert(S, D_[at].diagonal(), f.S_inverse[at], f.log_determinant)) return std::nullopt;
    const Eigen::Matrix3d& inverse = f.S_inverse[at];
    RS.noalias() = f.R.middleCols<3>(3 * i) * inverse;
    f.C.noalias() -= RS * f.R.middleCols<3>(3 * i).transpose();
    f.g_shared.noalias() -= RS * f.g_poses.segment<3>(3 * i);
    if (i + 1 == poses_) break;
    const Eigen::Matrix3d G = O_[at] * inverse;
    S = D_[at + 1];
    S.diagonal() *= 1.0 + damping;
    S.noalias() -= G * O_[at].transpose();
    f.R.middleCols<3>(3 * i + 3).noalias() -= RS * O_[at].transpose();
    f.g_poses.segment<3>(3 * i + 3).noalias() -= G * f.g_poses.segment<3>(3 * i);
  }
  return f;
}

std::optional<ChainSystem::Solution> ChainSystem::solve(double damping) const {
  const auto f = factors(damping);
  if (!f) return std::nullopt;
  Solution solution{.poses = Eigen::Matrix3Xd(3, poses_),
                    .shared = Eigen::VectorXd(shared_),
                    .log_determinant = f->log_determinant};
  if (shared_ > 0) {
    const Eigen::LLT<Eigen::MatrixXd> llt(f->C);
    if (llt.info() != Eigen::Success) return std::nullopt;
    solution.shared = llt.solve(f->g_shared);
  }
  if (!solution.shared.allFinite()) return std::nullopt;
  for (Eigen::Index i = poses_; i-- > 0;) {
    const auto at = static_cast<std::size_t>(i);
    Eigen::Vector3d rest = f->g_poses.segment<3>(3 * i);
    if (shared_ > 0) rest.noalias() -= f->R.middleCols<3>(3 * i).transpose() * solution.shared;
    if (i + 1 < poses_) rest.noalias() -= O_[at].transpose() * solution.poses.col(i + 1);
    solution.poses.col(i).noalias() = f->S_inverse[at] * rest;
  }
  if (!solution.poses.allFinite()) return std::nullopt;
  return solution;
}

std::optional<ChainSystem::Reduced> ChainSystem::reduced() const {
  auto f = factors(0.0);
  if (!f) return std::nullopt;
  return Reduced{std::move(f->C), std::move(f->g_shared)};
}

std::optional<ChainSystem::Covariance> ChainSystem::covariance() const {
  const auto f = factors(0.0);
  if (!f) return std::nullopt;
  const auto poses = D_.size();
  Covariance covariance{.shared = Eigen::MatrixXd(shared_, shared_),
                        .poses = std::vector<Eigen::Matrix3d>(poses),
                        .next = std::vector<Eigen::Matrix3d>(poses - 1),
                        .shared_pose = std::vector<Eigen::MatrixXd>(poses)};
  if (shared_ > 0) {
    const Eigen::LLT<Eigen::MatrixXd> llt(f->C);
    if (llt.info() != Eigen::Success) return std::nullopt;
    const Eigen::MatrixXd L = llt.matrixL();
    if (!(L.diagonal().array().square() > kLeastChainPivot * C_.diagonal().array()).all())
      return std::nullopt;
    covariance.shared = llt.solve(Eigen::MatrixXd::Identity(shared_, shared_));
  }
  Eigen::Matrix3d next = Eigen::Matrix3d::Zero();
  Eigen::MatrixXd next_shared = Eigen::MatrixXd::Zero(shared_, 3);
  for (std::size_t i = poses; i-- > 0;) {
    // x_i depends on what comes after it by x_i = -S_i^-1 (O_i' x_{i+1} + R_i' shared) + noise.
    const Eigen::Matrix3d A = -f->S_inverse[i] * O_[i].transpose();
    const Eigen::MatrixXd E =
        -f->S_inverse[i] * f->R.middleCols<3>(3 * static_cast<Eigen::Index>(i)).transpose();
    const Eigen::MatrixXd E_shared = E * covariance.shared;
    const Eigen::Matrix3d cross = A * (E * next_shared).transpose();
    if (i + 1 < poses) covariance.next[i] = A * next + E * next_shared;
    covariance.shared_pose[i] = next_shared * A.transpose() + E_shared.transpose();
    covariance.poses[i] = f->S_inverse[i] + A * next * A.transpose() + E_shared * E.transpose() +
                          cross + cross.transpose();
    next = covariance.poses[i];
    next_shared = covariance.shared_pose[i];
  }
  return covariance;
}

}  // namespace mapproof
