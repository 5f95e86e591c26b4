#include "core/missing/regularised_pca.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// The start with x and W sharing the size of their product evenly, as the penalty wants it.
LowRankModel balanced_start(const Features& matrix, const RegularisedPcaOptions& options) {
  LowRankModel start = pairwise_start(matrix, options.dimensions);
  const double columns = static_cast<double>(matrix.values.cols());
  const Eigen::ArrayXd norms = start.loadings.colwise().norm().transpose().array();
  const double largest = std::sqrt(columns) * norms.maxCoeff();
  start.ridge = std::max(options.penalty_share * largest, least_noise(matrix));
  // |W_k| = sqrt(s_k) for a singular value s_k = |w_k| sqrt(C).
  start.loadings *=
      (std::sqrt(std::sqrt(columns)) * norms.max(1e-6 * norms.maxCoeff() + 1e-150).sqrt().inverse())
          .matrix()
          .asDiagonal();
  return start;
}

}  // namespace

RegularisedPca regularised_pca(const Features& matrix, const RegularisedPcaOptions& options) {
  require_low_rank(matrix, options.dimensions);
  if (options.max_iterations < 1 || !(options.least_fall >= 0.0) ||
      !(options.penalty_share > 0.0 && options.penalty_share <= 1.0))
    throw InvalidInput("regularised PCA needs an iteration, a fall of 0 or more, a penalty");
  const std::vector<ColumnGroup> groups = column_groups(matrix);
  const Eigen::Index q = options.dimensions;
  const Eigen::MatrixXd known = Eigen::MatrixXd::Zero(q, q);
  RegularisedPca result{.model = balanced_start(matrix, options), .losses = {}, .statuses = {}};
  LowRankModel& model = result.model;
  bool settled = false;
  while (!settled && std::ssize(result.losses) < options.max_iterations) {
    Moments moments(matrix.values.rows(), q);
    for (const ColumnGroup& group : groups)
      moments.add(matrix, group, fit_group(matrix, group, model), known);
    double loss = model.ridge * moments.all.diagonal().head(q).sum();
    for (Eigen::Index i = 0; i < matrix.values.rows(); ++i)
      loss += moments.regress(i, model.ridge, model) +
              model.ridge * model.loadings.row(i).squaredNorm();
    settled = !result.losses.empty() &&
              result.losses.back() - loss <= options.least_fall * result.losses.back();
    result.losses.push_back(loss);
  }
  if (!settled)
    result.statuses.push_back(status_of<StatusReason::kLossFalling>(options.max_iterations));
  return result;
}

}  // namespace mapproof
