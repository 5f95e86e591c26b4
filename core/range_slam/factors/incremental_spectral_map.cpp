#include "core/range_slam/factors/incremental_spectral_map.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/gram.hpp"
#include "core/linalg/packed_product.hpp"
#include "core/linalg/symmetric_eigen.hpp"
#include "core/range_slam/factors/quadric.hpp"
#include "core/range_slam/factors/upgrade_transform.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kRank = 4;
/// Steps that determine a quadric.
constexpr Eigen::Index kLeastStepsToMap = 8;
/// Coordinates whose fourth moments are kept.
constexpr Eigen::Index kFrame = 8;
/// Steps that wait before they are folded in: of each landmark, so that the eigenvectors take less
/// time than the products, even where all are computed, in O(N^3); and at least.
constexpr Eigen::Index kBlockALandmark = 4;
constexpr Eigen::Index kLeastBlock = 32;
/// Eigenvalues of the Gram matrix below this share of the largest are rounding.
constexpr double kGramRounding = 1e-14;

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

/// Moments of the monomials of the first kRank of q coordinates.
Eigen::MatrixXd of_first_four(const Eigen::MatrixXd& moments, Eigen::Index q) {
  std::vector<Eigen::Index> kept;
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < q; ++i)
    for (Eigen::Index j = i; j < q; ++j, ++row)
      if (j < kRank) kept.push_back(row);
  return moments(kept, kept);
}

}  // namespace

IncrementalSpectralMap::IncrementalSpectralMap(Eigen::Index landmarks) {
  if (landmarks < 1) throw InvalidInput("an incremental map needs landmarks");
  gram_ = Eigen::MatrixXd::Zero(landmarks, landmarks);
  sum_ = Eigen::VectorXd::Zero(landmarks);
  pending_.resize(landmarks, std::max(kBlockALandmark * landmarks, kLeastBlock));
  frame_.resize(landmarks, 0);
  to_frame_.resize(0, landmarks);
}

void IncrementalSpectralMap::add(const Eigen::VectorXd& half_squares) {
  if (half_squares.size() != sum_.size() || !half_squares.allFinite())
    throw InvalidInput("a step needs one finite squared range for each landmark");
  pending_.col(pending_count_++) = half_squares;
  ++steps_;
  if (pending_count_ == pending_.cols()) fold();
}

void IncrementalSpectralMap::fold() {
  if (pending_count_ == 0) return;
  const auto pending = pending_.leftCols(pending_count_);
  add_gram(pending, 1.0, gram_);
  mirror_lower(gram_);
  sum_ += pending.rowwise().sum();

  // The frame of the new Gram matrix, and the moments of old columns in it.
  const EigenPairs leading =
      leading_eigenpairs(gram_ / double(steps_), frame_,
                         {.exact = std::min<Eigen::Index>(kRank, gram_.rows()), .count = kFrame});
  const double least = kGramRounding * leading.values(0);
  const Eigen::Index q = (leading.values.array() > least).count();
  const Eigen::MatrixXd U = leading.vectors.leftCols(q);
  const Eigen::VectorXd roots = leading.values.head(q).cwiseSqrt();
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

Factorization IncrementalSpectralMap::spectrum() const {
  Factorization result;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      Eigen::MatrixXd(gram_ / double(steps_)), Eigen::EigenvaluesOnly);
  const Eigen::ArrayXd eigenvalues = solver.eigenvalues().reverse();
  const double least = kGramRounding * eigenvalues(0);
  result.singular_values = (eigenvalues > least).select(double(steps_) * eigenvalues, 0.0).sqrt();
  judge_rank(result, kRank);
  return result;
}

Factorization IncrementalSpectralMap::factors() const {
  // Four whitened coordinates; eight states m + d, m - d have their mean and mean square I.
  Factorization result = spectrum();
  result.U = frame_.leftCols(kRank);
  const Eigen::Vector4d mean = mean_state();
  const Eigen::MatrixXd D =
      2.0 * root_of(Eigen::Matrix4d::Identity() - mean * mean.transpose()).transpose();
  result.V.resize(kRank, 2 * kRank);
  result.V << D.colwise() + mean, (-D).colwise() + mean;
  return result;
}

Eigen::Vector4d IncrementalSpectralMap::mean_state() const {
  return to_frame_.topRows(kRank) * sum_ / double(steps_);
}

std::optional<SpectralMap> IncrementalSpectralMap::without_map(Eigen::Index least_steps,
                                                               StatusCode flat) const {
  SpectralMap none;
  if (sum_.size() < kRank || steps_ < least_steps) {
    none.statuses.push_back(
        status_of<StatusReason::kFewLandmarksAtSteps>(sum_.size(), steps_, kRank, least_steps));
    return none;
  }
  if (frame_.cols() >= kRank) return std::nullopt;
  none.statuses = spectrum().statuses;
  none.statuses.push_back(status_of<StatusReason::kStepsFlat>(frame_.cols(), kRank));
  none.statuses.back().code = flat;
  return none;
}

SpectralMap IncrementalSpectralMap::map(const KnownLandmarks& known) const {
  IncrementalSpectralMap all = *this;
  all.fold();
  if (const auto none = all.without_map(kRank, StatusCode::kFailed)) return *none;
  SpectralMap map = map_from_known_landmarks(all.factors(), known);
  map.X.resize(4, 0);
  return map;
}

SpectralMap IncrementalSpectralMap::map() const {
  IncrementalSpectralMap all = *this;
  all.fold();
  if (const auto none = all.without_map(kLeastStepsToMap, StatusCode::kDegenerateGeometry))
    return *none;
  const Eigen::MatrixXd U = all.frame_.leftCols(kRank);
  const UpgradeTransform transform =
      upgrade_transform(U, all.mean_state(),
                        root_of(of_first_four(all.moments_, all.frame_.cols())), kMomentRounding);
  SpectralMap map;
  map.condition = transform.condition;
  map.statuses = all.spectrum().statuses;
  map.statuses.insert(map.statuses.end(), transform.statuses.begin(), transform.statuses.end());
  if (!transform.S.isZero()) map.C = U * transform.S;
  return map;
}

}  // namespace mapproof
