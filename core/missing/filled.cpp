#include "core/missing/filled.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

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

/// x <- L^-1 (x - its mean) with L L' the covariance of all x, and the inverse for the model.
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

constexpr std::array kNames = {std::string_view("pairwise-complete"), std::string_view("ppca"),
                               std::string_view("pca"), std::string_view("mean")};

/// The missing rows of a group.
std::vector<Eigen::Index> missing_rows(const ColumnGroup& group, Eigen::Index rows) {
  std::vector<Eigen::Index> missing;
  auto observed = group.rows.begin();
  for (Eigen::Index i = 0; i < rows; ++i) {
    if (observed != group.rows.end() && *observed == i)
      ++observed;
    else
      missing.push_back(i);
  }
  return missing;
}

/// A completed matrix, and the sum over its columns of the filled entries' covariances.
struct Filled {
  Eigen::MatrixXd values;      ///< M x C.
  Eigen::MatrixXd covariance;  ///< M x M.
};

/// @param with_covariance  The model's ridge is the variance of noise, its x standard normal.
Filled fill(const Features& matrix, const LowRankModel& model, bool with_covariance) {
  const Eigen::Index M = matrix.values.rows();
  Filled result{.values = matrix.values, .covariance = Eigen::MatrixXd::Zero(M, M)};
  for (const ColumnGroup& group : column_groups(matrix)) {
    const std::vector<Eigen::Index> missing = missing_rows(group, M);
    if (missing.empty()) continue;
    const GroupFit fit = fit_group(matrix, group, model);
    const Eigen::MatrixXd W = model.loadings(missing, Eigen::all);
    result.values(missing, group.columns) =
        (W * fit.x).colwise() + Eigen::VectorXd(model.mean(missing));
    if (!with_covariance) continue;
    Eigen::MatrixXd spread = W * fit.inverse * W.transpose();
    spread.diagonal().array() += 1.0;
    result.covariance(missing, missing) +=
        static_cast<double>(group.columns.size()) * model.ridge * spread;
  }
  return result;
}

/// Of each row's observed entries.
LowRankModel means_alone(const Features& matrix) {
  return {.loadings = Eigen::MatrixXd::Zero(matrix.values.rows(), 1),
          .mean = matrix.values.rowwise().sum().cwiseQuotient(matrix.observed.rowwise().sum()),
          .ridge = 1.0};
}

/// The model that a filling fits, and its outcome.
LowRankModel fitted_model(const Features& matrix, const FillingOptions& options,
                          std::vector<Status>& statuses) {
  if (options.filling == Filling::kMean) return means_alone(matrix);
  const auto most = static_cast<int>(matrix.values.rows() - 1);
  if (options.filling == Filling::kPpca) {
    PpcaOptions fitting = options.ppca;
    fitting.dimensions = std::min(fitting.dimensions, most);
    Ppca fitted = ppca(matrix, fitting);
    statuses = std::move(fitted.statuses);
    return std::move(fitted.model);
  }
  RegularisedPcaOptions fitting = options.pca;
  fitting.dimensions = std::min(fitting.dimensions, most);
  RegularisedPca fitted = regularised_pca(matrix, fitting);
  statuses = std::move(fitted.statuses);
  return std::move(fitted.model);
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
  // Negligible compared with the data: a row of few entries keeps a regular matrix.
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
        fmt::format("{} dimensions requested of {}: 1 to {} are possible", dimensions, M, M - 1));
  if (!matrix.values.allFinite()) throw InvalidInput("the matrix has entries that are not finite");
  if (matrix.observed.size() == 0) return;
  if (matrix.observed.rows() != M || matrix.observed.cols() != matrix.values.cols())
    throw InvalidInput("the mask of observed entries differs from the matrix in size");
  if (!(matrix.observed.rowwise().sum().array() > 0.0).all())
    throw InvalidInput("the matrix has a row without an observed entry");
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
  bool converged = false;
  while (!converged && std::ssize(result.losses) < options.max_iterations) {
    Moments moments(matrix.values.rows(), q);
    for (const ColumnGroup& group : groups)
      moments.add(matrix, group, fit_group(matrix, group, model), known);
    double loss = model.ridge * moments.all.diagonal().head(q).sum();
    for (Eigen::Index i = 0; i < matrix.values.rows(); ++i)
      loss += moments.regress(i, model.ridge, model) +
              model.ridge * model.loadings.row(i).squaredNorm();
    converged = !result.losses.empty() &&
                result.losses.back() - loss <= options.least_fall * result.losses.back();
    result.losses.push_back(loss);
  }
  if (!converged)
    result.statuses.push_back(status_of<StatusReason::kLossFalling>(options.max_iterations));
  return result;
}

Ppca ppca(const Features& matrix, const PpcaOptions& options) {
  require_low_rank(matrix, options.dimensions);
  if (options.max_iterations < 1 || !(options.least_rise >= 0.0))
    throw InvalidInput("PPCA needs an iteration or more and a least rise of 0 or more");
  const std::vector<ColumnGroup> groups = column_groups(matrix);
  const double entries = observed_entries(matrix);
  Ppca result;
  LowRankModel next = pairwise_start(matrix, options.dimensions);
  const double floor = least_noise(matrix);
  bool converged = false;
  for (int iteration = 0;; ++iteration) {
    Moments moments(matrix.values.rows(), options.dimensions);
    const double likelihood = expect(matrix, groups, next, moments);
    if (iteration > 0) {
      result.rises.push_back(likelihood - result.log_likelihood);
      converged = result.rises.back() <= options.least_rise * entries;
    }
    result.log_likelihood = likelihood;
    result.model = next;
    if (converged || iteration == options.max_iterations) break;
    maximise(moments, entries, floor, next);
    whiten(moments, next);
  }
  if (!converged)
    result.statuses.push_back(status_of<StatusReason::kLikelihoodRising>(options.max_iterations));
  return result;
}

std::string_view name(Filling filling) { return kNames[static_cast<std::size_t>(filling)]; }

std::optional<Filling> filling_named(std::string_view name) {
  for (std::size_t i = 0; i < kNames.size(); ++i)
    if (kNames[i] == name) return static_cast<Filling>(i);
  return std::nullopt;
}

FilledProximities filled_proximities(const ObservationHistory& history, Eigen::Index steps,
                                     const FillingOptions& options) {
  FilledProximities result;
  const Features matrix = features(history, steps);
  if (options.filling == Filling::kPairwiseComplete || matrix.observed.size() == 0) {
    result.proximities = proximities(matrix, history.sensor);
    return result;
  }
  result.model = fitted_model(matrix, options, result.statuses);
  result.proximities =
      filled_from(matrix, history.sensor, result.model, CompletedDistances::kOfFilled);
  return result;
}

Proximities filled_from(const Features& matrix, Sensor sensor, const LowRankModel& model,
                        CompletedDistances distances) {
  Filled filled = fill(matrix, model, distances == CompletedDistances::kExpected);
  // Squared ranges are centred on their mean over time, which missing data had moved.
  if (sensor == Sensor::kRange)
    filled.values.colwise() -= Eigen::VectorXd(filled.values.rowwise().mean());
  return proximities_of_products(gram(filled.values) + filled.covariance, sensor);
}

}  // namespace mapproof
