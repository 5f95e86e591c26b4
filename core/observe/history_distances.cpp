#include "core/observe/history_distances.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/parallel.hpp"
#include "core/linalg/packed_product.hpp"
#include "core/observe/bit_rows.hpp"
#include "core/observe/features.hpp"

namespace mapproof {
namespace {

using Eigen::Index;
using Take = VisitedDistances::Take;

/// Of 1 - cos of the angle between visibility rows.
double visibility_distance(double products, double scale) {
  const double cosine = scale > 0.0 ? products / scale : 0.0;
  return std::sqrt(std::max(2.0 - 2.0 * cosine, 0.0));
}

/// The lists of `keys` rows, one behind the other: of each landmark its steps, or the reverse.
struct Lists {
  std::vector<std::size_t> first;  ///< One more at the end.
  std::vector<std::int32_t> members;

  std::span<const std::int32_t> of(std::size_t key) const {
    return {members.data() + first[key], first[key + 1] - first[key]};
  }
};

/// What was seen, as lists both ways; all else was not seen.
class SeenLists {
 public:
  SeenLists(Index landmarks, Index steps) {
    steps_.first.resize(static_cast<std::size_t>(landmarks) + 1);
    landmarks_.first.resize(static_cast<std::size_t>(steps) + 1);
  }

  // All that was seen is given twice, in one order, ascending in steps or in landmarks.
  void count(Index landmark, Index step) {
    ++steps_.first[static_cast<std::size_t>(landmark) + 1];
    ++landmarks_.first[static_cast<std::size_t>(step) + 1];
  }
  void end_count() {
    for (Lists* lists : {&steps_, &landmarks_}) {
      std::partial_sum(lists->first.begin(), lists->first.end(), lists->first.begin());
      lists->members.resize(lists->first.back());
    }
    next_step_ = steps_.first;
    next_landmark_ = landmarks_.first;
  }
  void list(Index landmark, Index step) {
    const auto i = static_cast<std::size_t>(landmark), t = static_cast<std::size_t>(step);
    steps_.members[next_step_[i]++] = static_cast<std::int32_t>(step);
    landmarks_.members[next_landmark_[t]++] = static_cast<std::int32_t>(landmark);
  }
  void end_list() { next_step_ = next_landmark_ = {}; }

  Index landmarks() const { return std::ssize(steps_.first) - 1; }

  /// How many groups the landmarks fall into if those of a step belong to one.
  int groups() const;

  void visit(const Take& take) const;

 private:
  class Row;

  Lists steps_;      ///< Of each landmark.
  Lists landmarks_;  ///< Of each step.
  std::vector<std::size_t> next_step_, next_landmark_;
};

int SeenLists::groups() const {
  std::vector<std::int32_t> parent(static_cast<std::size_t>(landmarks()));
  std::iota(parent.begin(), parent.end(), 0);
  const auto of = [&](std::int32_t node) {
    while (parent[static_cast<std::size_t>(node)] != node) {
      std::int32_t& up = parent[static_cast<std::size_t>(node)];
      node = up = parent[static_cast<std::size_t>(up)];
    }
    return node;
  };
  auto groups = static_cast<int>(landmarks());
  for (std::size_t step = 0; step + 1 < landmarks_.first.size(); ++step)
    for (const std::int32_t landmark : landmarks_.of(step)) {
      const std::int32_t a = of(landmark), b = of(landmarks_.of(step).front());
      if (a == b) continue;
      parent[static_cast<std::size_t>(a)] = b;
      --groups;
    }
  return groups;
}

/// Counts the steps that one landmark has in common with each other [gustavson1978].
class SeenLists::Row {
 public:
  explicit Row(const SeenLists& seen)
      : seen_(seen), counts_(static_cast<std::size_t>(seen.landmarks())) {}

  /// The distances to all landmarks that were seen together with it.
  std::span<const Edge> distances(Index i) {
    met_.clear();
    edges_.clear();
    const std::span<const std::int32_t> steps = seen_.steps_.of(static_cast<std::size_t>(i));
    for (const std::int32_t step : steps)
      for (const std::int32_t other : seen_.landmarks_.of(static_cast<std::size_t>(step)))
        if (counts_[static_cast<std::size_t>(other)]++ == 0) met_.push_back(other);
    const auto own = static_cast<double>(steps.size());
    for (const std::int32_t other : met_) {
      const auto j = static_cast<std::size_t>(other);
      const auto common = static_cast<double>(std::exchange(counts_[j], 0));
      if (other == i) continue;
      const auto others = static_cast<double>(seen_.steps_.of(j).size());
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

void SeenLists::visit(const Take& take) const {
  constexpr Index kRowsAtATime = 256;
  const Index parts = (landmarks() + kRowsAtATime - 1) / kRowsAtATime;
  parallel_for(static_cast<std::size_t>(parts), [&](std::size_t part) {
    Row row(*this);
    const Index first = static_cast<Index>(part) * kRowsAtATime;
    for (Index i = first; i < std::min(first + kRowsAtATime, landmarks()); ++i)
      take(i, row.distances(i));
  });
}

HistoryDistances distances_of(std::shared_ptr<const SeenLists> seen) {
  HistoryDistances result{.landmarks = seen->landmarks(),
                          .distances = {.visit = {}, .others = std::numbers::sqrt2},
                          .apart = std::numbers::sqrt2,
                          .groups = seen->groups()};
  result.distances.visit = [seen = std::move(seen)](const Take& take) { seen->visit(take); };
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
  BlockedDistances(const ObservationHistory& history, Index steps, Index rows_at_a_time);

  void visit(const Take& take) const;

 private:
  /// Some rows, as their products need them.
  struct Rows {
    Index first = 0;
    Index count = 0;
    Eigen::MatrixXd values;    ///< Features; empty: the rows are bits.
    Eigen::MatrixXd observed;  ///< 1 where a value is; empty unless it is multiplied.
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
  bool multiplies_observed() const { return are_missing_ && history_.sensor != Sensor::kBearing; }
  bool are_bits() const { return seen_.rows() > 0; }

  const ObservationHistory& history_;
  Index steps_;
  Index rows_at_a_time_;
  bool are_missing_;
  BitRows observed_;  ///< If entries are missing.
  BitRows seen_;      ///< Of visibility that is 0 and 1 alone.
};

BitRows bits_where(const ObservationHistory& history, Index steps, bool seen) {
  BitRows bits(history.landmarks(), steps);
  over_rows(history.landmarks(), [&](Index first, Index count) {
    for (Index t = 0; t < steps; ++t)
      for (Index i = first; i < first + count; ++i)
        if (seen ? history.values(i, t) > 0.0 : !std::isnan(history.values(i, t))) bits.set(i, t);
  });
  return bits;
}

/// Rows of one block: its values take 256 MB or less, and no more than serves.
Index block_rows(Index landmarks, Index columns) {
  constexpr double kMostValues = 3.2e7;
  constexpr Index kFewest = 64, kMost = 4096;
  const double rows = kMostValues / static_cast<double>(columns);
  return std::min(landmarks, std::clamp(static_cast<Index>(rows), kFewest, kMost));
}

BlockedDistances::BlockedDistances(const ObservationHistory& history, Index steps,
                                   Index rows_at_a_time)
    : history_(history),
      steps_(steps),
      rows_at_a_time_(rows_at_a_time > 0
                          ? rows_at_a_time
                          : block_rows(history.landmarks(),
                                       history.sensor == Sensor::kBearing ? 2 * steps : steps)),
      are_missing_(history.values.leftCols(steps).array().isNaN().any()) {
  if (are_missing_) observed_ = bits_where(history, steps, false);
  if (mapproof::are_bits(history, steps)) seen_ = bits_where(history, steps, true);
}

BlockedDistances::Rows BlockedDistances::rows(Index first) const {
  Rows block{.first = first,
             .count = std::min(rows_at_a_time_, history_.landmarks() - first),
             .values = {},
             .observed = {},
             .squares = Eigen::VectorXd(std::min(rows_at_a_time_, history_.landmarks() - first))};
  if (are_bits()) {
    for (Index r = 0; r < block.count; ++r)
      seen_.in_common(first + r, seen_, first + r, 1, &block.squares(r));
    return block;
  }
  const Index columns = history_.sensor == Sensor::kBearing ? 2 * steps_ : steps_;
  block.values.resize(block.count, columns);
  if (multiplies_observed()) block.observed.resize(block.count, columns);
  over_rows(block.count, [&](Index part, Index count) {
    Features some = features({.sensor = history_.sensor,
                              .names = {},
                              .values = history_.values.block(first + part, 0, count, steps_)},
                             steps_);
    block.values.middleRows(part, count) = some.values;
    block.squares.segment(part, count) = some.values.rowwise().squaredNorm();
    if (!multiplies_observed()) return;
    if (some.observed.size() == 0) some.observed.setOnes(count, columns);
    block.observed.middleRows(part, count) = some.observed;
  });
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
  add_product(j.observed, i_values.cwiseAbs2(), 1.0, sums.i_squares.middleCols(first, count));
  add_product(j.values.cwiseAbs2(), i.observed.middleRows(first, count), 1.0,
              sums.j_squares.middleCols(first, count));
}

/// As proximities() has it. @param common  Steps at which both were observed.
double BlockedDistances::distance(double product, double i_squares, double j_squares,
                                  double common) const {
  if (common == 0.0) return kInfinity;
  if (history_.sensor == Sensor::kVisibility)
    return visibility_distance(product, std::sqrt(i_squares * j_squares));
  const double scale = are_missing_ ? static_cast<double>(steps_) / common : 1.0;
  return std::sqrt(scale * std::max(i_squares + j_squares - 2.0 * product, 0.0));
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

/// The landmarks seen at some step, for each step: work(landmark, step).
template <typename Work>
void for_each_seen(const ObservationHistory& history, Index steps, const Work& work) {
  for (Index t = 0; t < steps; ++t)
    for (Index i = 0; i < history.landmarks(); ++i)
      if (history.values(i, t) > 0.0) work(i, t);
}

SeenLists seen_lists(const ObservationHistory& history, Index steps) {
  SeenLists seen(history.landmarks(), steps);
  for_each_seen(history, steps, [&](Index i, Index t) { seen.count(i, t); });
  seen.end_count();
  for_each_seen(history, steps, [&](Index i, Index t) { seen.list(i, t); });
  seen.end_list();
  return seen;
}

/// Whether lists are counted faster than bits: at shares below 6 % everywhere alike. Measured: a
/// landmark of a list takes as long as 256 entries as bits.
bool is_sparse(const ObservationHistory& history, Index steps) {
  double products = 0.0;
  for (Index t = 0; t < steps; ++t) {
    const auto seen = static_cast<double>((history.values.col(t).array() > 0.0).count());
    products += seen * seen;
  }
  const auto M = static_cast<double>(history.landmarks());
  return 256.0 * products < M * M * static_cast<double>(steps);
}

}  // namespace

HistoryDistances history_distances(const ObservationHistory& history, Index steps,
                                   Index rows_at_a_time) {
  require_steps(history, steps);
  const bool is_visibility = history.sensor == Sensor::kVisibility;
  const bool is_complete = !history.values.leftCols(steps).array().isNaN().any();
  if (is_complete && are_bits(history, steps) && is_sparse(history, steps))
    return distances_of(std::make_shared<SeenLists>(seen_lists(history, steps)));
  HistoryDistances result{.landmarks = history.landmarks(), .distances = {}};
  if (is_visibility) {
    result.apart = std::numbers::sqrt2;
    result.groups = seen_lists(history, steps).groups();
  }
  result.distances.visit = [blocks =
                                std::make_shared<BlockedDistances>(history, steps, rows_at_a_time)](
                               const Take& take) { blocks->visit(take); };
  return result;
}

HistoryDistances visibility_distances(const DetectionLog& log) {
  const auto M = static_cast<Index>(log.names.size());
  auto seen = std::make_shared<SeenLists>(M, log.steps);
  for (const Detection& one : log.detections) {
    if (one.landmark < 0 || one.landmark >= M || one.step < 0 || one.step >= log.steps)
      throw InvalidInput("a detection names a landmark or a step that its log does not have");
    seen->count(one.landmark, one.step);
  }
  seen->end_count();
  for (const Detection& one : log.detections) seen->list(one.landmark, one.step);
  seen->end_list();
  return distances_of(std::move(seen));
}

}  // namespace mapproof
