#include "core/submaps/join_fit.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/linalg/decompositions.hpp"
#include "core/statistics/intervals.hpp"

namespace mapproof {
namespace {

/// In the plane the median residual of normal errors is 1.1774 standard deviations of a coordinate;
/// twice that.
constexpr double kTrusted = 2.0 / 1.1774;

Affine about_means(const Points& from, const Points& to, const Eigen::VectorXd& shares,
                   const Eigen::Matrix2d& linear) {
  const Eigen::RowVector2d source = shares.transpose() * from;
  const Eigen::RowVector2d target = shares.transpose() * to;
  return {.linear = linear, .offset = target - source * linear};
}

}  // namespace

Affine fit_join(const Points& from, const Points& to, const Eigen::VectorXd& weights,
                JoinKind kind) {
  const Eigen::VectorXd shares = weights / weights.sum();
  const Points A = from.rowwise() - shares.transpose() * from;
  const Points B = to.rowwise() - shares.transpose() * to;
  const Eigen::Matrix2d cross = A.transpose() * shares.asDiagonal() * B;
  if (kind == JoinKind::kAffine) {
    const Eigen::Matrix2d own = A.transpose() * shares.asDiagonal() * A;
    const Eigen::Matrix2d linear = own.completeOrthogonalDecomposition().solve(cross);
    return about_means(from, to, shares, linear);
  }
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(cross, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix2d linear = svd.matrixU() * svd.matrixV().transpose();
  const double spread = shares.dot(A.rowwise().squaredNorm());
  if (kind == JoinKind::kSimilarity && spread > 0.0) linear *= svd.singularValues().sum() / spread;
  return about_means(from, to, shares, linear);
}

Eigen::VectorXd huber_weights(const Eigen::VectorXd& residuals, double median) {
  const double trusted = std::max(kTrusted * median, 1e-12 * residuals.maxCoeff());
  if (!(trusted > 0.0)) return Eigen::VectorXd::Ones(residuals.size());
  return (trusted / residuals.array().max(trusted)).matrix();
}

Affine fit_join_robustly(const Points& from, const Points& to, JoinKind kind, double& residual) {
  constexpr int kRounds = 20;
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(from.rows());
  Affine fit;
  Eigen::VectorXd residuals;
  for (int round = 0; round < kRounds; ++round) {
    fit = fit_join(from, to, weights, kind);
    residuals = (fit(from) - to).rowwise().norm();
    const std::span<const double> values(residuals.data(),
                                         static_cast<std::size_t>(residuals.size()));
    weights = huber_weights(residuals, median(values));
  }
  const Points centred = to.rowwise() - to.colwise().mean();
  const double radius = std::sqrt(centred.squaredNorm() / static_cast<double>(to.rows()));
  residual =
      std::sqrt(weights.dot(residuals.cwiseAbs2()) / weights.sum()) / std::max(radius, 1e-300);
  return fit;
}

}  // namespace mapproof
