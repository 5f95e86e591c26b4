#include "core/range_slam/online.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "core/base/errors.hpp"
#include "core/linalg/sign.hpp"
#include "core/range_slam/quadric.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kFrame = 8;
constexpr Eigen::Index kLeastBlock = 32;
/// Eigenvalues of the Gram matrix below this share of the largest are rounding.
constexpr double kRounding = 1e-15;

/// The matrix that takes quadratic_monomials() of z to those of A z.
Eigen::MatrixXd on_monomials(const Eigen::MatrixXd& A) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> to, from;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = i; j < A.rows(); ++j) to.emplace_back(i, j);
  for (Eigen::Index i = 0; i < A.cols(); ++i)
    for (Eigen::Index j = i; j < A.cols(); ++j) from.emplace_back(i, j);
  Eigen::MatrixXd K(std::ssize(to), std::ssize(from));
  for (Eigen::Index r = 0; r < K.rows(); ++r)
    for (Eigen::Index c = 0; c < K.cols(); ++c) {
      const auto [i, j] = to[static_cast<std::size_t>(r)];
      const auto [k, l] = from[static_cast<std::size_t>(c)];
      const double weight =
          (i == j ? 1.0 : std::numbers::sqrt2) * (k == l ? 0.5 : std::numbers::sqrt2 / 2.0);
      K(r, c) = weight * (A(i, k) * A(j, l) + A(i, l) * A(j, k));
    }
  return K;
}

/// Rows R with R'R = M, M positive semidefinite up to rounding.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& M) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(M);
  return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal() *
         solver.eigenvectors().transpose();
}

/// Moments of the monomials of the first four of q coordinates.
Eigen::MatrixXd of_first_four(const Eigen::MatrixXd& moments, Eigen::Index q) {
  std::vector<Eigen::Index> kept;
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < q; ++i)
    for (Eigen::Index j = i; j < q; ++j, ++row)
      if (j < 4) kept.push_back(row);
  return moments(kept, kept);
}

}  // namespace

OnlineSpectralMap::OnlineSpectralMap(Eigen::Index landmarks) {
  if (landmarks < 1) throw InvalidInput("an online map needs landmarks");
  gram_ = Eigen::MatrixXd::Zero(landmarks, landmarks);
  sum_ = Eigen::VectorXd::Zero(landmarks);
  pending_.resize(landmarks, std::max(landmarks, kLeastBlock));
  frame_.resize(landmarks, 0);
  to_frame_.resize(0, landmarks);
}

void OnlineSpectralMap::add(const Eigen::VectorXd& half_squares) {
  if (half_squares.size() != sum_.size() || !half_squares.allFinite())
    throw InvalidInput("a step needs one finite squared range for each landmark");
  pending_.col(pending_count_++) = half_squares;
  ++steps_;
  if (pending_count_ == pending_.cols()) fold();
}

void OnlineSpectralMap::fold() {
  if (pending_count_ == 0) return;
  const auto pending = pending_.leftCols(pending_count_);
  gram_.noalias() += pending * pending.transpose();
  sum_ += pending.rowwise().sum();

  // The frame of the new Gram matrix, and the moments of old columns in it.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(gram_ / double(steps_));
  eigenvalues_ = solver.eigenvalues().reverse();
  const double least = kRounding * eigenvalues_(0);
  const Eigen::Index q = std::min<Eigen::Index>(kFrame, (eigenvalues_.array() > least).count());
  Eigen::MatrixXd U = solver.eigenvectors().rowwise().reverse().leftCols(q);
  fix_signs(U);
  const Eigen::VectorXd roots = eigenvalues_.head(q).cwiseSqrt();
  to_frame_ = roots.cwiseInverse().asDiagonal() * U.transpose();
  const Eigen::MatrixXd K = on_monomials(to_frame_ * frame_);
  const Eigen::Index terms = q * (q + 1) / 2;
  Eigen::MatrixXd moments = Eigen::MatrixXd::Zero(terms, terms);
  if (K.cols() > 0) moments = K * moments_ * K.transpose();
  frame_ = U * roots.asDiagonal();

  const Eigen::MatrixXd monomials = quadratic_monomials(to_frame_ * pending);
  moments_ = moments + monomials.transpose() * monomials;
  pending_count_ = 0;
}

Factorization OnlineSpectralMap::factors() const {
  // Four whitened coordinates; eight states m + d, m - d have their mean and mean square I.
  Factorization result;
  result.U = frame_.leftCols(4);
  const Eigen::Vector4d mean = to_frame_.topRows(4) * sum_ / double(steps_);
  const Eigen::MatrixXd D =
      2.0 * root_of(Eigen::Matrix4d::Identity() - mean * mean.transpose()).transpose();
  result.V.resize(4, 8);
  result.V << D.colwise() + mean, (-D).colwise() + mean;
  result.singular_values = (double(steps_) * eigenvalues_.cwiseMax(0.0)).cwiseSqrt();
  result.condition = result.singular_values(0) / result.singular_values(3);
  result.noise_floor = eigenvalues_.size() > 4 ? result.singular_values(4) : 0.0;
  return result;
}

SpectralMap OnlineSpectralMap::map(const KnownLandmarks& known) const {
  OnlineSpectralMap all = *this;
  all.fold();
  SpectralMap map;
  if (all.frame_.cols() < 4 || steps_ < 4) {
    map.statuses.push_back(
        {StatusCode::kTooFewObservations,
         fmt::format("{} steps span {} dimensions; 4 are needed.", steps_, all.frame_.cols())});
    return map;
  }
  map = map_from_known_landmarks(all.factors(), known);
  map.X.resize(4, 0);
  return map;
}

SpectralMap OnlineSpectralMap::map() const {
  OnlineSpectralMap all = *this;
  all.fold();
  SpectralMap map;
  if (all.frame_.cols() < 4 || steps_ < 9) {
    map.statuses.push_back({StatusCode::kTooFewObservations,
                            fmt::format("{} steps span {} dimensions; 9 in 4 are needed.", steps_,
                                        all.frame_.cols())});
    return map;
  }
  const Eigen::Vector4d mean = all.to_frame_.topRows(4) * all.sum_ / double(steps_);
  const Eigen::MatrixXd U = all.frame_.leftCols(4);
  const UpgradeTransform transform =
      upgrade_transform(U, mean, root_of(of_first_four(all.moments_, all.frame_.cols())));
  map.condition = transform.condition;
  map.statuses = transform.statuses;
  if (!transform.S.isZero()) map.C = U * transform.S;
  return map;
}

}  // namespace mapproof
