#include "core/observe/proximities.hpp"

#include <limits>
#include <optional>

namespace mapproof {
namespace {

/// X Y', the half below the diagonal mirrored: exactly symmetric where X Y' is.
Eigen::MatrixXd gram(const Eigen::MatrixXd& X) {
  Eigen::MatrixXd G = Eigen::MatrixXd::Zero(X.rows(), X.rows());
  G.selfadjointView<Eigen::Lower>().rankUpdate(X);
  return G.selfadjointView<Eigen::Lower>();
}

/// Q(i, j): sum of i's squared values over the steps that i and j have in common.
Eigen::MatrixXd common_squares(const Features& observed, const Eigen::MatrixXd& G) {
  if (observed.observed.size() == 0) return G.diagonal().replicate(1, G.cols());
  return observed.values.cwiseAbs2() * observed.observed.transpose();
}

/// Visibility: G becomes the cosines, distances 2 - 2 cos.
void normalise(Proximities& result, const Eigen::MatrixXd& Q) {
  const Eigen::ArrayXXd scale = (Q.array() * Q.transpose().array()).sqrt();
  result.inner_products = (scale > 0.0).select(result.inner_products.array() / scale, 0.0);
  result.squared_distances = (2.0 - 2.0 * result.inner_products.array()).max(0.0);
}

}  // namespace

Proximities proximities(const ObservationHistory& history, Eigen::Index steps) {
  return proximities(features(history, steps), history.sensor);
}

Proximities proximities(const Features& rows, Sensor sensor) {
  Proximities result{.inner_products = gram(rows.values), .squared_distances = {}};
  const Eigen::MatrixXd Q = common_squares(rows, result.inner_products);
  if (sensor == Sensor::kVisibility) {
    normalise(result, Q);
  } else {
    const Eigen::MatrixXd both = Q + Q.transpose();
    result.squared_distances = (both - 2.0 * result.inner_products).cwiseMax(0.0);
  }

  if (rows.observed.size() > 0) {
    const Eigen::ArrayXXd common = gram(rows.observed).array();
    const double infinity = std::numeric_limits<double>::infinity();
    if (sensor != Sensor::kVisibility) {
      const Eigen::ArrayXXd scale = static_cast<double>(rows.values.cols()) / common.max(1.0);
      result.squared_distances.array() *= scale;
      result.inner_products.array() *= scale;
    }
    result.squared_distances = (common > 0.0).select(result.squared_distances, infinity);
  }
  result.squared_distances.diagonal().setZero();
  return result;
}

std::vector<Eigen::Index> unseen_landmarks(const ObservationHistory& history, Eigen::Index steps) {
  require_steps(history, steps);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < history.landmarks(); ++i) {
    const auto row = history.values.row(i).leftCols(steps).array();
    const bool seen =
        history.sensor == Sensor::kVisibility ? (row > 0.0).any() : (row == row).any();
    if (!seen) rows.push_back(i);
  }
  return rows;
}

ObservationHistory with_rows(const ObservationHistory& history,
                             const std::vector<Eigen::Index>& rows) {
  ObservationHistory subset{.sensor = history.sensor, .names = {}, .values = {}};
  subset.values = history.values(rows, Eigen::all);
  for (const Eigen::Index row : rows)
    subset.names.push_back(history.names[static_cast<std::size_t>(row)]);
  return subset;
}

}  // namespace mapproof
