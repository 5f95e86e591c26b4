#include "core/observe/proximities.hpp"

#include <utility>

#include "core/base/not_finite.hpp"
#include "core/linalg/gram.hpp"

namespace mapproof {
namespace {

/// |a|^2 + |b|^2 - 2 a'b, where every entry was observed.
Eigen::MatrixXd squared_distances(const Eigen::MatrixXd& G) {
  const Eigen::ArrayXd squares = G.diagonal();
  Eigen::MatrixXd D(G.rows(), G.cols());
  for (Eigen::Index j = 0; j < G.cols(); ++j)
    D.col(j) = ((squares + squares(j)) - 2.0 * G.col(j).array()).max(0.0);
  return D;
}

/// Visibility: G becomes the cosines, distances 2 - 2 cos.
void normalise(Proximities& result, const Eigen::MatrixXd& Q) {
  const Eigen::ArrayXXd scale = (Q.array() * Q.transpose().array()).sqrt();
  result.inner_products = (scale > 0.0).select(result.inner_products.array() / scale, 0.0);
  result.squared_distances = (2.0 - 2.0 * result.inner_products.array()).max(0.0);
  result.apart_squared = 2.0;
}

}  // namespace

Proximities proximities(const ObservationHistory& history, Eigen::Index steps) {
  return proximities(features(history, steps), history.sensor);
}

Proximities proximities(const Features& rows, Sensor sensor) {
  if (rows.observed.size() == 0) return proximities_of_products(gram(rows.values), sensor);
  Proximities result{.inner_products = gram(rows.values), .squared_distances = {}};
  // Q(i, j): sum of i's squared values over the steps that i and j have in common.
  const Eigen::MatrixXd Q = rows.values.cwiseAbs2() * rows.observed.transpose();
  const Eigen::ArrayXXd common = gram(rows.observed).array();
  if (sensor == Sensor::kVisibility) {
    normalise(result, Q);
  } else {
    const Eigen::ArrayXXd scale = static_cast<double>(rows.values.cols()) / common.max(1.0);
    result.squared_distances =
        scale * (Q + Q.transpose() - 2.0 * result.inner_products).cwiseMax(0.0).array();
    result.inner_products.array() *= scale;
  }
  result.squared_distances = (common > 0.0).select(result.squared_distances, kInfinity);
  result.squared_distances.diagonal().setZero();
  return result;
}

Proximities proximities_of_products(Eigen::MatrixXd inner_products, Sensor sensor) {
  Proximities result{.inner_products = std::move(inner_products), .squared_distances = {}};
  if (sensor == Sensor::kVisibility)
    normalise(result, result.inner_products.diagonal().replicate(1, result.inner_products.cols()));
  else
    result.squared_distances = squared_distances(result.inner_products);
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
