#include "core/range_slam/factors/factorization.hpp"

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/sign.hpp"
#include "core/range_slam/factors/quadric.hpp"

namespace mapproof {
namespace {

/// Singular values down to this share of the largest are rounding.
constexpr double kRounding = 1e-13;
/// A kept singular value is signal only if it stands out by this from the largest left out.
constexpr double kAboveFloor = 1.5;

void check(const Eigen::MatrixXd& Y, Eigen::Index rank) {
  if (rank < 1 || rank > std::min(Y.rows(), Y.cols()))
    throw InvalidInput("a factorisation's rank must be 1 to the lesser side of the matrix");
  if (!Y.allFinite()) throw InvalidInput("a factorisation needs finite entries");
}

}  // namespace

void judge_rank(Factorization& result, Eigen::Index rank) {
  const Eigen::VectorXd& s = result.singular_values;
  const double smallest = s(rank - 1);
  result.noise_floor = s.size() > rank ? s(rank) : 0.0;
  result.condition = smallest > 0.0 ? s(0) / smallest : kInfinity;
  const double floor = std::max(kRounding * s(0), kAboveFloor * result.noise_floor);
  if (smallest > floor) return;
  const auto signals = (s.head(rank).array() > floor).count();
  result.statuses.push_back(
      status_of<StatusReason::kRankOfRanges>(signals, rank, result.condition));
}

Factorization factorize(const Eigen::MatrixXd& Y, Eigen::Index rank) {
  check(Y, rank);
  // A matrix with the left singular vectors and singular values of Y, at most N x N.
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(triangle_of(Y.transpose()).transpose(),
                                           Eigen::ComputeThinU);
  Factorization result;
  result.U = svd.matrixU().leftCols(rank);
  fix_signs(result.U);
  result.V = result.U.transpose() * Y;
  result.singular_values = svd.singularValues();
  judge_rank(result, rank);
  return result;
}

Factorization factorize_without_noise(const Eigen::MatrixXd& Y, const Eigen::VectorXd& variances,
                                      Eigen::Index rank) {
  check(Y, rank);
  if (variances.size() != Y.rows() || !variances.allFinite() || variances.minCoeff() < 0.0)
    throw InvalidInput("each row of a factorisation needs a finite noise variance of 0 or more");
  if (Y.rows() == rank) return factorize(Y, rank);

  Eigen::MatrixXd M = Y * Y.transpose();
  M.diagonal() -= static_cast<double>(Y.cols()) * variances;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(M);
  Factorization result;
  result.U = solver.eigenvectors().rowwise().reverse().leftCols(rank);
  fix_signs(result.U);
  result.V = result.U.transpose() * Y;
  result.singular_values = solver.eigenvalues().reverse().cwiseMax(0.0).cwiseSqrt();
  judge_rank(result, rank);
  return result;
}

}  // namespace mapproof
