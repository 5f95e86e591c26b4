#include "core/observe/history_distances.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "core/base/parallel.hpp"
#include "core/linalg/packed_product.hpp"
#include "core/observe/bit_rows.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"
#include "core/observe/seen_lists.hpp"

namespace mapproof {
namespace {

using Eigen::Index;
using Take = VisitedDistances::Take;

/// Of 1 - cos of the angle between visibility rows.
double visibility_distance(double products, double scale) {
  const double cosine = scale > 0.0 ? products / scale : 0.0;
  return std::sqrt(std::max(2.0 - 2.0 * cosine, 0.0));
}

/// Counts the steps that one landmark has in common with each other [gustavson1978].
class CommonSteps {
 public:
  explicit CommonSteps(const SeenLists& seen)
      : seen_(seen), counts_(static_cast<std::size_t>(seen.landmarks())) {}

  /// The distances to all landmarks that were seen together with it.
  std::span<const Edge> distances(Index i) {
    met_.clear();
    edges_.clear();
    const std::span<const std::int32_t> steps = seen_.steps_of(static_cast<std::size_t>(i));
    for (const std::int32_t step : steps)
      for (const std::int32_t other : seen_.landmarks_of(static_cast<std::size_t>(step)))
        if (counts_[static_cast<std::size_t>(other)]++ == 0) met_.push_back(other);
    const auto own = static_cast<double>(steps.size());
    for (const std::int32_t other : met_) {
      const auto j = static_cast<std::size_t>(other);
      const auto common = static_cast<double>(std::exchange(counts_[j], 0));
      if (other == i) continue;
      const auto others = static_cast<double>(seen_.steps_of(j).size());
      edges_.push_back({other, visibility_distance(common, std::sqrt(own * others))});
    }
    return edges_;
  }

 private:
  const SeenLists& seen_;
  std::vector<std::int32_t> counts_;  ///< Zero between rows.
  std::vector<std::int32_t> met_;
  std::vector<Edge> edges_;
};

void visit(const SeenLists& seen, const Take& take) {
  constexpr Index kRowsAtATime = 256;
  const Index parts = (seen.landmarks() + kRowsAtATime - 1) / kRowsAtATime;
  parallel_for(static_cast<std::size_t>(parts), [&](std::size_t part) {
    CommonSteps common(seen);
    const Index first = static_cast<Index>(part) * kRowsAtATime;
    for (Index i = first; i < std::min(first + kRowsAtATime, seen.landmarks()); ++i)
      take(i, common.distances(i));
  });
}

HistoryDistances distances_of(std::shared_ptr<const SeenLists> seen) {
  HistoryDistances result{.landmarks = seen->landmarks(),
                          .distances = VisitedDistances{.visit = {}, .others = std::numbers::sqrt2},
                          .apart = std::numbers::sqrt2,
                          .groups = seen->groups()};
  result.distances.visit = [seen = std::move(seen)](const Take& take) { visit(*seen, take); };
  return result;
}

/// Calls work(first, count) for parts of so many rows, several at a time.
template <typename Work>
void over_rows(Index rows, const Work& work) {
  constexpr Index kRowsAtATime = 64;
  const Index parts = (rows + kRowsAtATime - 1) / kRowsAtATime;
  parallel_for(static_cast<std::size_t>(parts), [&](std::size_t part) {
    const Index first = static_cast<Index>(part) * kRowsAtATime;
    work(first, std::min(kRowsAtATime, rows - first));
  });
}

/// Distances as products of blocks of rows, which hold all of their steps.
class BlockedDistances {
 public:
  BlockedDistances(const HistoryBlocks& history, Index steps, Index rows_at_a_time);

  void visit(const Take& take) const;

 private:
  /// Some rows, as their products need them.
  struct Rows {
    Index first = 0;
    Index count = 0;
    Eigen::MatrixXd values;    ///< Features; empty: the rows are bits.
    Eigen::MatrixXd observed;  ///< 1 where a value is; empty unless it is multiplied.
    Eigen::MatrixXd squared;   ///< Of each value; likewise.
    Eigen::VectorXd squares;   ///< Of each row's values.
  };
  /// Sums over the steps that two landmarks share, between rows `i` (columns here) and `j` (rows
  /// here).
  struct Sums {
    Eigen::MatrixXd products;              ///< Becomes the distances.
    Eigen::MatrixXd i_squares, j_squares;  ///< Of values of i, of j, where both were observed.
  };

  Rows rows(Index first) const;
  Eigen::MatrixXd distances(const Rows& i, const Rows& j) const;
  void add_columns(const Rows& i, const Rows& j, Index first, Index count, Sums& sums) const;
  double distance(double product, double i_squares, double j_squares, double common) const;
  bool multiplies_observed() const { return are_missing_ && history_.sensor() != Sensor::kBearing; }
  bool are_bits() const { return seen_.rows() > 0; }

  HistoryBlocks history_;
  Index steps_;
  bool are_missing_;
  Index rows_at_a_time_;
  BitRows observed_;  ///< If entries are missing.
  BitRows seen_;      ///< Of visibility that is 0 and 1 alone.
};

/// Rows of one block: two of them and their sums take 512 MB or less, where 64 rows do.
/// @param columns  Of all arrays of a block together. @param sums  Arrays of block x block.
Index block_rows(Index landmarks, Index columns, Index sums) {
  constexpr double kMostValues = 2.4e7, kMostSums = 1.6e7;
  constexpr Index kFewest = 64, kMost = 4096;
  const double rows = std::min(kMostValues / static_cast<double>(columns),
                               std::sqrt(kMostSums / static_cast<double>(sums)));
  return std::min(landmarks, std::clamp(static_cast<Index>(rows), kFewest, kMost));
}

BlockedDistances::BlockedDistances(const HistoryBlocks& history, Index steps, Index rows_at_a_time)
    : history_(history),
      steps_(steps),
      are_missing_(misses_any(history, steps)),
      rows_at_a_time_(rows_at_a_time > 0
                          ? rows_at_a_time
                          : block_rows(history.landmarks(),
                                       (history.sensor() == Sensor::kBearing ? 2 : 1) *
                                           (multiplies_observed() ? 3 : 1) * steps,
                                       multiplies_observed() ? 3 : 1)) {
  if (!are_missing_ && history.sensor() != Sensor::kVisibility) return;
  HistoryBits bits = history_bits(history, steps);
  if (are_missing_) observed_ = std::move(bits.observed);
  if (bits.are_all) seen_ = std::move(bits.seen);
}

BlockedDistances::Rows BlockedDistances::rows(Index first) const {
  const Index size = std::min(rows_at_a_time_, history_.landmarks() - first);
  Rows block{.first = first,
             .count = size,
             .values = {},
             .observed = {},
             .squared = {},
             .squares = Eigen::VectorXd(size)};
  if (are_bits()) {
    for (Index r = 0; r < block.count; ++r)
      seen_.in_common(first + r, seen_, first + r, 1, &block.squares(r));
    return block;
  }
  const Index columns = history_.sensor() == Sensor::kBearing ? 2 * steps_ : steps_;
  block.values.resize(block.count, columns);
  if (multiplies_observed()) block.observed.resize(block.count, columns);
  const Eigen::MatrixXd values = history_.values_of(first, size, 0, steps_);
  over_rows(block.count, [&](Index part, Index count) {
    Features some = features(
        {.sensor = history_.sensor(), .names = {}, .values = values.middleRows(part, count)},
        steps_);
    block.values.middleRows(part, count) = some.values;
    block.squares.segment(part, count) = some.values.rowwise().squaredNorm();
    if (!multiplies_observed()) return;
    if (some.observed.size() == 0) some.observed.setOnes(count, columns);
    block.observed.middleRows(part, count) = some.observed;
  });
  if (multiplies_observed()) block.squared = block.values.cwiseAbs2();
  return block;
}

void BlockedDistances::add_columns(const Rows& i, const Rows& j, Index first, Index count,
                                   Sums& sums) const {
  if (are_bits()) {
    for (Index c = first; c < first + count; ++c) {
      seen_.in_common(i.first + c, seen_, j.first, j.count, sums.products.col(c).data());
      if (!are_missing_) continue;
      seen_.in_common(i.first + c, observed_, j.first, j.count, sums.i_squares.col(c).data());
      observed_.in_common(i.first + c, seen_, j.first, j.count, sums.j_squares.col(c).data());
    }
    return;
  }
  const auto i_values = i.values.middleRows(first, count);
  add_product(j.values, i_values, 1.0, sums.products.middleCols(first, count));
  if (!multiplies_observed()) return;
  add_product(j.observed, i.squared.middleRows(first, count), 1.0,
              sums.i_squares.middleCols(first, count));
  add_product(j.squared, i.observed.middleRows(first, count), 1.0,
              sums.j_squares.middleCols(first, count));
}

/// As proximities() has it, but 0 where the sums differ by no more than their rounding: the
/// products of equal rows are summed in another order than their squares.
/// @param common  Steps at which both were observed.
double BlockedDistances::distance(double product, double i_squares, double j_squares,
                                  double common) const {
  if (common == 0.0) return kInfinity;
  if (history_.sensor() == Sensor::kVisibility)
    return visibility_distance(product, std::sqrt(i_squares * j_squares));
  const double scale = are_missing_ ? static_cast<double>(steps_) / common : 1.0;
  const double squares = i_squares + j_squares, squared = squares - 2.0 * product;
  // A sum of n products is off by n roundings at most; a bearing has two products a step.
  constexpr double kRounding = std::numeric_limits<double>::epsilon();
  if (squared <= 2.0 * static_cast<double>(steps_) * kRounding * squares) return 0.0;
  return std::sqrt(scale * squared);
}

/// j.count x i.count.
Eigen::MatrixXd BlockedDistances::distances(const Rows& i, const Rows& j) const {
  Sums sums{.products = Eigen::MatrixXd::Zero(j.count, i.count), .i_squares = {}, .j_squares = {}};
  const bool has_squares = are_missing_ && (are_bits() || multiplies_observed());
  if (has_squares) sums.i_squares = sums.j_squares = sums.products;
  over_rows(i.count, [&](Index first, Index count) {
    add_columns(i, j, first, count, sums);
    Eigen::VectorXd common = Eigen::VectorXd::Constant(j.count, static_cast<double>(steps_));
    for (Index c = first; c < first + count; ++c) {
      if (are_missing_)
        observed_.in_common(i.first + c, observed_, j.first, j.count, common.data());
      auto column = sums.products.col(c);
      for (Index r = 0; r < j.count; ++r) {
        // A bearing's vector has length 1.
        const double i_squares = has_squares    ? sums.i_squares(r, c)
                                 : are_missing_ ? common(r)
                                                : i.squares(c);
        const double j_squares = has_squares    ? sums.j_squares(r, c)
                                 : are_missing_ ? common(r)
                                                : j.squares(r);
        column(r) = distance(column(r), i_squares, j_squares, common(r));
      }
    }
  });
  return std::move(sums.products);
}

/// Gives the rows of `D` to `take`, whose columns are the others.
template <typename Matrix>
void take_rows(const Matrix& D, Index first_row, Index first_column, const Take& take) {
  over_rows(D.rows(), [&](Index first, Index count) {
    std::vector<Edge> edges(static_cast<std::size_t>(D.cols()));
    for (Index r = first; r < first + count; ++r) {
      edges.clear();
      for (Index c = 0; c < D.cols(); ++c)
        if (std::isfinite(D(r, c)) && first_row + r != first_column + c)
          edges.push_back({first_column + c, D(r, c)});
      take(first_row + r, edges);
    }
  });
}

void BlockedDistances::visit(const Take& take) const {
  for (Index first = 0; first < history_.landmarks(); first += rows_at_a_time_) {
    const Rows i = rows(first);
    take_rows(distances(i, i), first, first, take);
    for (Index next = first + rows_at_a_time_; next < history_.landmarks();
         next += rows_at_a_time_) {
      const Eigen::MatrixXd D = distances(i, rows(next));
      take_rows(D, next, first, take);
      take_rows(D.transpose(), first, next, take);
    }
  }
}

}  // namespace

HistoryDistances history_distances(const HistoryBlocks& history, Index steps,
                                   Index rows_at_a_time) {
  require_steps(history, steps);
  const bool is_visibility = history.sensor() == Sensor::kVisibility;
  if (is_sparse_visibility(history, steps))
    return distances_of(std::make_shared<SeenLists>(history, steps));
  HistoryDistances result{.landmarks = history.landmarks(), .distances = {}};
  if (is_visibility) {
    result.apart = std::numbers::sqrt2;
    result.groups = SeenLists(history, steps).groups();
  }
  result.distances.visit = [blocks =
                                std::make_shared<BlockedDistances>(history, steps, rows_at_a_time)](
                               const Take& take) { blocks->visit(take); };
  return result;
}

HistoryDistances visibility_distances(const DetectionLog& log) {
  return distances_of(std::make_shared<SeenLists>(log));
}

}  // namespace mapproof
