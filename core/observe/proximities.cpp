#include "core/observe/proximities.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/not_finite.hpp"
#include "core/linalg/gram.hpp"
#include "core/linalg/packed_product.hpp"

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
    normalise(result, Q);
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

constexpr Eigen::Index kBits = 64;

// By the processor's own instruction, where it has it.
#if defined(__x86_64__)
#define MAPPROOF_POPCOUNT [[gnu::target_clones("popcnt", "default")]]
#else
#define MAPPROOF_POPCOUNT
#endif

/// The bits that both have, for one row and some others, which follow each other.
MAPPROOF_POPCOUNT void count_in_common(const std::uint64_t* row, const std::uint64_t* others,
                                       Eigen::Index words, Eigen::Index count, double* out) {
  for (Eigen::Index j = 0; j < count; ++j, others += words) {
    std::uint64_t ones = 0;
    for (Eigen::Index k = 0; k < words; ++k)
      ones += static_cast<std::uint64_t>(std::popcount(row[k] & others[k]));
    out[j] = static_cast<double>(ones);
  }
}

/// Rows of bits, 64 of them in a word: what was seen at each step, or observed.
class BitRows {
 public:
  /// A bit for each entry, 1 where it is not zero.
  /// @note rows * columns / 8 bytes.
  explicit BitRows(
      const Eigen::Ref<const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>>& bits);

  Eigen::Index rows() const { return rows_; }

  /// How many columns have a 1 in row i of this and in row j of the other, for each i and j.
  /// @param other  With as many columns.
  /// @return Exact; what the product of both as matrices of 0 and 1 would be.
  /// @note rows * other.rows * columns / 64 steps.
  Eigen::MatrixXd in_common(const BitRows& other) const;

 private:
  const std::uint64_t* row(Eigen::Index i) const { return words_.data() + i * words_in_row_; }

  Eigen::Index rows_;
  Eigen::Index words_in_row_;
  std::vector<std::uint64_t> words_;
};

BitRows::BitRows(const Eigen::Ref<const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>>& bits)
    : rows_(bits.rows()),
      words_in_row_((bits.cols() + kBits - 1) / kBits),
      words_(static_cast<std::size_t>(rows_ * words_in_row_)) {
  std::vector<std::uint64_t> together(static_cast<std::size_t>(rows_));
  for (Eigen::Index word = 0; word < words_in_row_; ++word) {
    std::ranges::fill(together, 0);
    const Eigen::Index first = word * kBits;
    for (Eigen::Index j = first; j < std::min(first + kBits, bits.cols()); ++j)
      for (Eigen::Index i = 0; i < rows_; ++i)
        together[static_cast<std::size_t>(i)] |= std::uint64_t{bits(i, j)} << (j - first);
    for (Eigen::Index i = 0; i < rows_; ++i)
      words_[static_cast<std::size_t>(i * words_in_row_ + word)] =
          together[static_cast<std::size_t>(i)];
  }
}

Eigen::MatrixXd BitRows::in_common(const BitRows& other) const {
  // Down the columns of the result: its row i is that of `other`, the rows of this are the columns.
  Eigen::MatrixXd transposed(other.rows(), rows_);
  for (Eigen::Index i = 0; i < rows_; ++i)
    count_in_common(row(i), other.words_.data(), words_in_row_, other.rows(),
                    transposed.col(i).data());
  return transposed.transpose();
}

/// Of rows of 0 and 1 alone, which are counted.
Proximities of_bits(const ObservationHistory& history, Eigen::Index steps) {
  const auto values = history.values.leftCols(steps).array();
  const BitRows seen(values > 0.0);
  Eigen::MatrixXd products = seen.in_common(seen);
  if (!values.isNaN().any())
    return proximities_of_products(std::move(products), Sensor::kVisibility);
  const BitRows observed(!values.isNaN());
  return of_common({.products = std::move(products),
                    .squares = seen.in_common(observed),
                    .steps = observed.in_common(observed),
                    .all = static_cast<double>(steps)},
                   Sensor::kVisibility);
}

bool are_bits(const ObservationHistory& history, Eigen::Index steps) {
  const auto values = history.values.leftCols(steps).array();
  return history.sensor == Sensor::kVisibility &&
         (values == 0.0 || values == 1.0 || values.isNaN()).all();
}

constexpr Eigen::Index kStepsAtATime = 4096;  // Their vectors fit the last cache.

/// Some steps after the other: the vectors of all would take twice the memory of the bearings.
Proximities of_bearings(const ObservationHistory& history, Eigen::Index steps) {
  const Eigen::Index n = history.landmarks();
  const bool are_missing = history.values.leftCols(steps).array().isNaN().any();
  CommonSums sums{.products = Eigen::MatrixXd::Zero(n, n), .squares = {}, .steps = {}};
  if (are_missing) sums.squares = sums.steps = sums.products;
  for (Eigen::Index first = 0; first < steps; first += kStepsAtATime) {
    const Eigen::Index count = std::min(kStepsAtATime, steps - first);
    Features rows = features(
        {.sensor = history.sensor, .names = {}, .values = history.values.middleCols(first, count)},
        count);
    add_gram(rows.values, 1.0, sums.products);
    sums.all += static_cast<double>(rows.values.cols());
    if (!are_missing) continue;
    if (rows.observed.size() == 0) rows.observed.setOnes(n, rows.values.cols());
    sums.squares += rows.values.cwiseAbs2() * rows.observed.transpose();
    add_gram(rows.observed, 1.0, sums.steps);
  }
  mirror_lower(sums.products);
  if (!are_missing) return proximities_of_products(std::move(sums.products), history.sensor);
  mirror_lower(sums.steps);
  return of_common(std::move(sums), history.sensor);
}

}  // namespace

Proximities proximities(const ObservationHistory& history, Eigen::Index steps) {
  require_steps(history, steps);
  if (are_bits(history, steps)) return of_bits(history, steps);
  if (history.sensor == Sensor::kBearing) return of_bearings(history, steps);
  return proximities(features(history, steps), history.sensor);
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
