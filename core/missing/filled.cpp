#include "core/missing/filled.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/errors.hpp"
#include "core/linalg/gram.hpp"

namespace mapproof {
namespace {

constexpr std::array kNames = {std::string_view("common-steps"), std::string_view("ppca"),
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
  if (options.filling == Filling::kCommonSteps || matrix.observed.size() == 0) {
    result.proximities = proximities(matrix, history.sensor);
    return result;
  }
  result.model = fitted_model(matrix, options, result.statuses);
  result.proximities = filled_from(matrix, history.sensor, result.model, GapDistances::kOfFilled);
  return result;
}

Proximities filled_from(const Features& matrix, Sensor sensor, const LowRankModel& model,
                        GapDistances distances) {
  Filled filled = fill(matrix, model, distances == GapDistances::kExpected);
  // Squared ranges are centred on their mean over time, which missing data had moved.
  if (sensor == Sensor::kRange)
    filled.values.colwise() -= Eigen::VectorXd(filled.values.rowwise().mean());
  return proximities_of_products(gram(filled.values) + filled.covariance, sensor);
}

}  // namespace mapproof
