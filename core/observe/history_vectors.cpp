#include "core/observe/history_vectors.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"
#include "core/observe/features.hpp"

namespace mapproof {
namespace {

using Eigen::Index;
using Eights = Eigen::Matrix<double, Eigen::Dynamic, 8, Eigen::RowMajor>;

/// Adds up the rows of `from` that each list names, into the rows of the result.
template <typename ListOf>
Eights sums_of(Index rows, const ListOf& list_of, const Eights& from) {
  constexpr Index kRowsAtATime = 256;
  Eights sums(rows, 8);
  parallel_for(static_cast<std::size_t>((rows + kRowsAtATime - 1) / kRowsAtATime),
               [&](std::size_t part) {
                 const Index first = static_cast<Index>(part) * kRowsAtATime;
                 for (Index i = first; i < std::min(first + kRowsAtATime, rows); ++i) {
                   Eigen::Matrix<double, 1, 8> sum = Eigen::Matrix<double, 1, 8>::Zero();
                   for (const std::int32_t j : list_of(static_cast<std::size_t>(i)))
                     sum += from.row(j);
                   sums.row(i) = sum;
                 }
               });
  return sums;
}

}  // namespace

HistoryVectors history_vectors(const HistoryBlocks& history, Index steps, Index most_held) {
  require_steps(history, steps);
  const Sensor sensor = history.sensor();
  if (sensor == Sensor::kVisibility)
    throw InvalidInput("vectors of visibility are lists of what was seen");
  Eigen::VectorXd means;
  if (sensor == Sensor::kRange) means = mean_squared_ranges(history, steps);
  const auto vectors_of = [sensor, means](const Eigen::MatrixXd& values) {
    return sensor == Sensor::kBearing ? directions(values) : features_of(values, sensor, means);
  };
  HistoryVectors result{.landmarks = history.landmarks(), .product = {}};
  const Index columns = sensor == Sensor::kBearing ? 2 * steps : steps;
  if (history.landmarks() * columns <= most_held) {
    const auto held =
        std::make_shared<Features>(features_of(history.values(0, steps), sensor, means));
    result.largest_square = held->values.rowwise().squaredNorm().maxCoeff();
    result.product = [held](const Eigen::MatrixXd& V) { return gram_product(held->values, V); };
    return result;
  }
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(history.landmarks());
  for_blocks(history, steps, [&](Index, const Eigen::MatrixXd& values) {
    squares += vectors_of(values).values.rowwise().squaredNorm();
  });
  result.largest_square = squares.maxCoeff();
  result.product = [history, steps, vectors_of](const Eigen::MatrixXd& V) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(V.rows(), V.cols());
    for_blocks(history, steps, [&](Index, const Eigen::MatrixXd& values) {
      sum += gram_product(vectors_of(values).values, V);
    });
    return sum;
  };
  return result;
}

HistoryVectors visibility_vectors(const SeenLists& seen) {
  Eigen::VectorXd inverse_lengths(seen.landmarks());
  for (Index i = 0; i < seen.landmarks(); ++i)
    inverse_lengths(i) =
        1.0 / std::sqrt(static_cast<double>(seen.steps_of(static_cast<std::size_t>(i)).size()));
  const auto product = [&seen, inverse_lengths](const Eigen::MatrixXd& V) {
    const Eights scaled = inverse_lengths.asDiagonal() * V;
    const Eights of_steps =
        sums_of(seen.steps(), [&](std::size_t t) { return seen.landmarks_of(t); }, scaled);
    const Eights of_landmarks =
        sums_of(seen.landmarks(), [&](std::size_t i) { return seen.steps_of(i); }, of_steps);
    return Eigen::MatrixXd(inverse_lengths.asDiagonal() * of_landmarks);
  };
  return {.landmarks = seen.landmarks(), .product = product, .largest_square = 1.0};
}

}  // namespace mapproof
