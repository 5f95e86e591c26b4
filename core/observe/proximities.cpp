#include "core/observe/proximities.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core/base/not_finite.hpp"
#include "core/linalg/gram.hpp"
#include "core/linalg/packed_product.hpp"
#include "core/linalg/unset_matrix.hpp"
#include "core/observe/bit_rows.hpp"

namespace mapproof {
namespace {

/// |a|^2 + |b|^2 - 2 a'b, where every entry was observed.
Eigen::MatrixXd squared_distances(const Eigen::MatrixXd& G) {
  const Eigen::ArrayXd squares = G.diagonal();
  Eigen::MatrixXd D = unset_matrix(G.rows(), G.cols());
  for (Eigen::Index j = 0; j < G.cols(); ++j)
    D.col(j) = ((squares + squares(j)) - 2.0 * G.col(j).array()).max(0.0);
  return D;
}

/// Visibility: G becomes the cosines, distances 2 - 2 cos.
/// @param squared_scale  Of column j: the product of the squared lengths of each pair's vectors.
template <typename SquaredScale>
void normalise(Proximities& result, const SquaredScale& squared_scale) {
  Eigen::MatrixXd& G = result.inner_products;
  result.squared_distances = unset_matrix(G.rows(), G.cols());
  for (Eigen::Index j = 0; j < G.cols(); ++j) {
    const Eigen::ArrayXd scale = squared_scale(j).sqrt();
    auto cosines = G.col(j).array();
    cosines = (scale > 0.0).select(cosines / scale, 0.0);
    result.squared_distances.col(j) = (2.0 - 2.0 * cosines).max(0.0);
  }
  result.apart_squared = 2.0;
}

/// Of the steps that each pair of rows has in common.
struct CommonSums {
  Eigen::MatrixXd products;  ///< Of i's value and j's.
  Eigen::MatrixXd squares;   ///< Q(i, j): of i's value.
  Eigen::MatrixXd steps;     ///< Their number, or twice that for bearings.
  double all = 0.0;          ///< The number without a missing value.
};

Proximities of_common(CommonSums sums, Sensor sensor) {
  Proximities result{.inner_products = std::move(sums.products), .squared_distances = {}};
  const Eigen::MatrixXd& Q = sums.squares;
  const auto common = sums.steps.array();
  if (sensor == Sensor::kVisibility) {
    normalise(result,
              [&](Eigen::Index j) { return Q.col(j).array() * Q.row(j).transpose().array(); });
  } else {
    const Eigen::ArrayXXd scale = sums.all / common.max(1.0);
    result.squared_distances =
        scale * (Q + Q.transpose() - 2.0 * result.inner_products).cwiseMax(0.0).array();
    result.inner_products.array() *= scale;
  }
  result.squared_distances = (common > 0.0).select(result.squared_distances, kInfinity);
  result.squared_distances.diagonal().setZero();
  return result;
}

/// Of rows of 0 and 1 alone, which are counted.
Proximities of_bits(const HistoryBits& bits, Eigen::Index steps) {
  if (!bits.misses_any) return proximities_of_products(bits.seen.in_common(), Sensor::kVisibility);
  return of_common({.products = bits.seen.in_common(),
                    .squares = bits.seen.in_common(bits.observed),
                    .steps = bits.observed.in_common(),
                    .all = static_cast<double>(steps)},
                   Sensor::kVisibility);
}

/// Some steps after the other: the vectors of all would take twice the memory of the bearings.
Proximities of_vectors(const HistoryBlocks& history, Eigen::Index steps) {
  const Eigen::Index n = history.landmarks();
  const bool are_missing = misses_any(history, steps);
  Eigen::VectorXd means;
  if (history.sensor() == Sensor::kRange) means = mean_squared_ranges(history, steps);
  CommonSums sums{.products = unset_matrix(n, n), .squares = {}, .steps = {}};
  sums.products.setZero();
  if (are_missing) sums.squares = sums.steps = sums.products;
  // Of longer histories than any study's, whose records keep libm's last bits.
  const bool is_fast =
      history.sensor() == Sensor::kBearing && !are_missing && steps > kStepsAtATime;
  for_blocks(history, steps, [&](Eigen::Index, const Eigen::MatrixXd& values) {
    Features rows = is_fast ? directions(values) : features_of(values, history.sensor(), means);
    add_gram(rows.values, 1.0, sums.products);
    sums.all += static_cast<double>(rows.values.cols());
    if (!are_missing) return;
    if (rows.observed.size() == 0) rows.observed.setOnes(n, rows.values.cols());
    sums.squares += rows.values.cwiseAbs2() * rows.observed.transpose();
    add_gram(rows.observed, 1.0, sums.steps);
  });
  mirror_lower(sums.products);
  if (!are_missing) return proximities_of_products(std::move(sums.products), history.sensor());
  mirror_lower(sums.steps);
  return of_common(std::move(sums), history.sensor());
}

}  // namespace

Proximities proximities(const HistoryBlocks& history, Eigen::Index steps) {
  require_steps(history, steps);
  if (history.sensor() == Sensor::kVisibility)
    if (const HistoryBits bits = history_bits(history, steps); bits.are_all)
      return of_bits(bits, steps);
  return of_vectors(history, steps);
}

Eigen::MatrixXd steps_observed_together(const HistoryBlocks& history, Eigen::Index steps) {
  require_steps(history, steps);
  if (history.is_complete())
    return Eigen::MatrixXd::Constant(history.landmarks(), history.landmarks(),
                                     static_cast<double>(steps));
  return history_bits(history, steps).observed.in_common();
}

Eigen::MatrixXd steps_seen_together(const HistoryBlocks& history, Eigen::Index steps) {
  if (history.sensor() != Sensor::kVisibility) return steps_observed_together(history, steps);
  require_steps(history, steps);
  return history_bits(history, steps).seen.in_common();
}

Proximities proximities(const Features& rows, Sensor sensor) {
  if (rows.observed.size() == 0) return proximities_of_products(gram(rows.values), sensor);
  return of_common({.products = gram(rows.values),
                    .squares = rows.values.cwiseAbs2() * rows.observed.transpose(),
                    .steps = gram(rows.observed),
                    .all = static_cast<double>(rows.values.cols())},
                   sensor);
}

Proximities proximities_of_products(Eigen::MatrixXd inner_products, Sensor sensor) {
  Proximities result{.inner_products = std::move(inner_products), .squared_distances = {}};
  const Eigen::ArrayXd squares = result.inner_products.diagonal();
  if (sensor == Sensor::kVisibility)
    normalise(result, [&](Eigen::Index j) { return squares * squares(j); });
  else
    result.squared_distances = squared_distances(result.inner_products);
  result.squared_distances.diagonal().setZero();
  return result;
}

bool misses_any(const HistoryBlocks& history, Eigen::Index steps) {
  if (history.is_complete()) return false;
  bool any = false;
  for_blocks(history, steps, [&](Eigen::Index, const Eigen::MatrixXd& values) {
    any = any || values.array().isNaN().any();
  });
  return any;
}

std::vector<Eigen::Index> unseen_landmarks(const HistoryBlocks& history, Eigen::Index steps) {
  require_steps(history, steps);
  constexpr Eigen::Index kSteps = 256;  // Most landmarks are seen within few.
  std::vector<Eigen::Index> rows(static_cast<std::size_t>(history.landmarks()));
  std::iota(rows.begin(), rows.end(), Eigen::Index{0});
  for (Eigen::Index first = 0; first < steps && !rows.empty(); first += kSteps) {
    const Eigen::MatrixXd values = history.values(first, std::min(kSteps, steps - first));
    std::erase_if(rows, [&](Eigen::Index i) {
      const auto row = values.row(i).array();
      return history.sensor() == Sensor::kVisibility ? (row > 0.0).any() : (row == row).any();
    });
  }
  return rows;
}

std::vector<Eigen::Index> other_rows(const std::vector<Eigen::Index>& rows, Eigen::Index count) {
  std::vector<Eigen::Index> others;
  for (Eigen::Index i = 0; i < count; ++i)
    if (!std::ranges::binary_search(rows, i)) others.push_back(i);
  return others;
}

std::vector<Eigen::Index> seen_landmarks(const HistoryBlocks& history, Eigen::Index steps) {
  return other_rows(unseen_landmarks(history, steps), history.landmarks());
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
