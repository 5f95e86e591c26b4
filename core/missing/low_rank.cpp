#include "core/missing/low_rank.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/gram.hpp"
#include "core/linalg/symmetric_eigen.hpp"

namespace mapproof {
namespace {

constexpr double kLeastNoiseShare = 1e-9;
constexpr double kLeastNoise = 1e-150;  ///< Of data that are all zero.

/// (x, 1) of each column.
Eigen::MatrixXd with_one(const Eigen::MatrixXd& x) {
  Eigen::MatrixXd result(x.rows() + 1, x.cols());
  result.topRows(x.rows()) = x;
  result.bottomRows(1).setOnes();
  return result;
}

}  // namespace

std::vector<ColumnGroup> column_groups(const Features& matrix) {
  const Eigen::Index M = matrix.values.rows();
  const bool complete = matrix.observed.size() == 0;
  std::map<std::vector<bool>, std::size_t> place;
  std::vector<ColumnGroup> groups;
  for (Eigen::Index c = 0; c < matrix.values.cols(); ++c) {
    std::vector<bool> pattern(static_cast<std::size_t>(M), true);
    for (Eigen::Index i = 0; i < M && !complete; ++i)
      pattern[static_cast<std::size_t>(i)] = matrix.observed(i, c) > 0.0;
    const auto [found, is_new] = place.try_emplace(std::move(pattern), groups.size());
    if (is_new) {
      groups.emplace_back();
      for (Eigen::Index i = 0; i < M; ++i)
        if (found->first[static_cast<std::size_t>(i)]) groups.back().rows.push_back(i);
    }
    groups[found->second].columns.push_back(c);
  }
  return groups;
}

GroupFit fit_group(const Features& matrix, const ColumnGroup& group, const LowRankModel& model) {
  const Eigen::Index q = model.loadings.cols();
  const Eigen::MatrixXd W = model.loadings(group.rows, Eigen::all);
  const Eigen::VectorXd mean = model.mean(group.rows);
  const Eigen::MatrixXd centred = matrix.values(group.rows, group.columns).colwise() - mean;
  Eigen::MatrixXd A = W.transpose() * W;
  A.diagonal().array() += model.ridge;
  const Eigen::LLT<Eigen::MatrixXd> factor(A);
  const Eigen::MatrixXd projected = W.transpose() * centred;
  GroupFit fit{.x = factor.solve(projected),
               .inverse = factor.solve(Eigen::MatrixXd(Eigen::MatrixXd::Identity(q, q))),
               .log_determinant = 2.0 * factor.matrixLLT().diagonal().array().log().sum()};
  fit.squared_left = centred.squaredNorm() - projected.cwiseProduct(fit.x).sum();
  return fit;
}

Moments::Moments(Eigen::Index rows, Eigen::Index dimensions)
    : products(Eigen::MatrixXd::Zero((dimensions + 1) * (dimensions + 1), rows)),
      values(Eigen::MatrixXd::Zero(dimensions + 1, rows)),
      squares(Eigen::VectorXd::Zero(rows)),
      all(Eigen::MatrixXd::Zero(dimensions + 1, dimensions + 1)) {}

void Moments::add(const Features& matrix, const ColumnGroup& group, const GroupFit& fit,
                  const Eigen::MatrixXd& spread) {
  const Eigen::Index q = fit.x.rows();
  const Eigen::MatrixXd x = with_one(fit.x);
  Eigen::MatrixXd product = x * x.transpose();
  product.topLeftCorner(q, q) += static_cast<double>(group.columns.size()) * spread;
  all += product;
  const Eigen::MatrixXd observed = matrix.values(group.rows, group.columns);
  const Eigen::MatrixXd value = x * observed.transpose();
  for (std::size_t k = 0; k < group.rows.size(); ++k) {
    const Eigen::Index row = group.rows[k];
    products.col(row) += product.reshaped();
    values.col(row) += value.col(static_cast<Eigen::Index>(k));
    squares(row) += observed.row(static_cast<Eigen::Index>(k)).squaredNorm();
  }
}

double Moments::regress(Eigen::Index row, double penalty, LowRankModel& model) const {
  const Eigen::Index q = model.loadings.cols();
  Eigen::MatrixXd A = products.col(row).reshaped(q + 1, q + 1);
  // As good as nothing beside the data: a row of few entries keeps a regular matrix.
  const double regular = 1e-12 * A.trace();
  A.diagonal().array() += regular;
  A.diagonal().head(q).array() += penalty;
  const Eigen::VectorXd weights = A.llt().solve(Eigen::VectorXd(values.col(row)));
  model.loadings.row(row) = weights.head(q).transpose();
  model.mean(row) = weights(q);
  const double left = squares(row) - values.col(row).dot(weights) -
                      penalty * weights.head(q).squaredNorm() - regular * weights.squaredNorm();
  return std::max(left, 0.0);
}

void require_low_rank(const Features& matrix, Eigen::Index dimensions) {
  const Eigen::Index M = matrix.values.rows();
  if (dimensions < 1 || dimensions >= M)
    throw InvalidInput(
        fmt::format("{} dimensions asked for of {}, 1 to {} can be", dimensions, M, M - 1));
  if (!matrix.values.allFinite()) throw InvalidInput("a matrix with entries that are not finite");
  if (matrix.observed.size() == 0) return;
  if (matrix.observed.rows() != M || matrix.observed.cols() != matrix.values.cols())
    throw InvalidInput("what was observed differs from the matrix in size");
  if (!(matrix.observed.rowwise().sum().array() > 0.0).all())
    throw InvalidInput("a row without an observed entry");
}

double observed_entries(const Features& matrix) {
  return matrix.observed.size() == 0 ? static_cast<double>(matrix.values.size())
                                     : matrix.observed.sum();
}

double least_noise(const Features& matrix) {
  const double mean_square = matrix.values.squaredNorm() / observed_entries(matrix);
  return std::max(kLeastNoiseShare * mean_square, kLeastNoise);
}

LowRankModel pairwise_start(const Features& matrix, Eigen::Index dimensions) {
  const Eigen::Index M = matrix.values.rows();
  const bool complete = matrix.observed.size() == 0;
  const Eigen::MatrixXd observed =
      complete ? Eigen::MatrixXd::Ones(M, matrix.values.cols()) : matrix.observed;
  LowRankModel start;
  start.mean = matrix.values.rowwise().sum().cwiseQuotient(observed.rowwise().sum().cwiseMax(1.0));
  const Eigen::MatrixXd centred = (matrix.values.colwise() - start.mean).cwiseProduct(observed);
  const Eigen::MatrixXd covariance = gram(centred).cwiseQuotient(gram(observed).cwiseMax(1.0));
  const EigenPairs pairs = largest_eigenpairs(covariance, dimensions);
  const double all = covariance.trace();
  const double beyond =
      (all - pairs.values.cwiseMax(0.0).sum()) / static_cast<double>(M - dimensions);
  start.ridge = std::max(beyond, least_noise(matrix));
  start.loadings =
      pairs.vectors *
      (pairs.values.array() - start.ridge).max(1e-3 * start.ridge).sqrt().matrix().asDiagonal();
  return start;
}

}  // namespace mapproof
