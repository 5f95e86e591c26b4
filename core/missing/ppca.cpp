#include "core/missing/ppca.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

/// Of a group's columns under the model.
double log_likelihood(const ColumnGroup& group, const GroupFit& fit, const LowRankModel& model) {
  const auto columns = static_cast<double>(group.columns.size());
  const auto rows = static_cast<double>(group.rows.size());
  const auto q = static_cast<double>(model.loadings.cols());
  const double log_covariance =
      (rows - q) * std::log(model.ridge) + fit.log_determinant;  // of W_o W_o' + noise I
  return -0.5 * (columns * (rows * std::log(2.0 * std::numbers::pi) + log_covariance) +
                 fit.squared_left / model.ridge);
}

/// E-step: moments of x given what was observed; returns the log likelihood.
double expect(const Features& matrix, const std::vector<ColumnGroup>& groups,
              const LowRankModel& model, Moments& moments) {
  double likelihood = 0.0;
  for (const ColumnGroup& group : groups) {
    const GroupFit fit = fit_group(matrix, group, model);
    likelihood += log_likelihood(group, fit, model);
    moments.add(matrix, group, fit, model.ridge * fit.inverse);
  }
  return likelihood;
}

/// M-step: rows regressed on x, noise from what is left.
void maximise(const Moments& moments, double entries, double floor, LowRankModel& model) {
  double left = 0.0;
  for (Eigen::Index i = 0; i < model.mean.size(); ++i) left += moments.regress(i, 0.0, model);
  model.ridge = std::max(left / entries, floor);
}

/// x <- L^-1 (x - its mean) with L L' the covariance of all x, and the model the other way about.
void whiten(const Moments& moments, LowRankModel& model) {
  const Eigen::Index q = model.loadings.cols();
  const double columns = moments.all(q, q);
  const Eigen::VectorXd mean = moments.all.col(q).head(q) / columns;
  const Eigen::MatrixXd covariance =
      moments.all.topLeftCorner(q, q) / columns - mean * mean.transpose();
  const Eigen::LLT<Eigen::MatrixXd> factor(covariance);
  if (factor.info() != Eigen::Success) return;
  model.mean += model.loadings * mean;
  model.loadings = model.loadings * Eigen::MatrixXd(factor.matrixL());
}

}  // namespace

Ppca ppca(const Features& matrix, const PpcaOptions& options) {
  require_low_rank(matrix, options.dimensions);
  if (options.max_iterations < 1 || !(options.least_rise >= 0.0))
    throw InvalidInput("PPCA needs an iteration or more and a least rise of 0 or more");
  const std::vector<ColumnGroup> groups = column_groups(matrix);
  const double entries = observed_entries(matrix);
  Ppca result;
  LowRankModel next = pairwise_start(matrix, options.dimensions);
  const double floor = least_noise(matrix);
  bool settled = false;
  for (int iteration = 0;; ++iteration) {
    Moments moments(matrix.values.rows(), options.dimensions);
    const double likelihood = expect(matrix, groups, next, moments);
    if (iteration > 0) {
      result.rises.push_back(likelihood - result.log_likelihood);
      settled = result.rises.back() <= options.least_rise * entries;
    }
    result.log_likelihood = likelihood;
    result.model = next;
    if (settled || iteration == options.max_iterations) break;
    maximise(moments, entries, floor, next);
    whiten(moments, next);
  }
  if (!settled)
    result.statuses.push_back(status_of<StatusReason::kLikelihoodRising>(options.max_iterations));
  return result;
}

}  // namespace mapproof
