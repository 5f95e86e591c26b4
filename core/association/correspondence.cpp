#include "core/association/correspondence.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/symmetric_eigen.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kNone = -1;

/// Rows assigned one by one, each along a path of least reduced cost to a free column.
class Assignment {
 public:
  explicit Assignment(const Eigen::MatrixXd& costs)
      : costs_(costs),
        row_price_(Eigen::VectorXd::Zero(costs.rows())),
        column_price_(Eigen::VectorXd::Zero(costs.cols())),
        row_of_(static_cast<std::size_t>(costs.cols()), kNone) {}

  void assign(Eigen::Index row) {
    const Eigen::Index m = costs_.cols();
    Eigen::VectorXd reach = Eigen::VectorXd::Constant(m, kInfinity);
    std::vector<Eigen::Index> before(static_cast<std::size_t>(m), kNone);
    std::vector<char> done(static_cast<std::size_t>(m), 0);
    Eigen::Index at = row;
    Eigen::Index column = kNone;
    double length = 0.0;
    do {
      Eigen::Index next = kNone;
      for (Eigen::Index j = 0; j < m; ++j) {
        if (done[static_cast<std::size_t>(j)] != 0) continue;
        const double through = length + costs_(at, j) - row_price_(at) - column_price_(j);
        if (through < reach(j)) {
          reach(j) = through;
          before[static_cast<std::size_t>(j)] = column;
        }
        if (next == kNone || reach(j) < reach(next)) next = j;
      }
      length = reach(next);
      column = next;
      done[static_cast<std::size_t>(column)] = 1;
      at = row_of_[static_cast<std::size_t>(column)];
    } while (at != kNone);
    reprice(row, reach, done, length);
    // Back along the path, each column takes the row of the one before it.
    while (column != kNone) {
      const Eigen::Index previous = before[static_cast<std::size_t>(column)];
      row_of_[static_cast<std::size_t>(column)] =
          previous == kNone ? row : row_of_[static_cast<std::size_t>(previous)];
      column = previous;
    }
  }

  std::vector<Eigen::Index> columns() const {
    std::vector<Eigen::Index> result(static_cast<std::size_t>(costs_.rows()), kNone);
    for (std::size_t j = 0; j < row_of_.size(); ++j)
      if (row_of_[j] != kNone)
        result[static_cast<std::size_t>(row_of_[j])] = static_cast<Eigen::Index>(j);
    return result;
  }

 private:
  /// Keeps reduced costs >= 0, and 0 on what is assigned.
  void reprice(Eigen::Index row, const Eigen::VectorXd& reach, const std::vector<char>& done,
               double length) {
    row_price_(row) += length;
    for (Eigen::Index j = 0; j < costs_.cols(); ++j) {
      if (done[static_cast<std::size_t>(j)] == 0) continue;
      column_price_(j) -= length - reach(j);
      if (row_of_[static_cast<std::size_t>(j)] != kNone)
        row_price_(row_of_[static_cast<std::size_t>(j)]) += length - reach(j);
    }
  }

  const Eigen::MatrixXd& costs_;
  Eigen::VectorXd row_price_;
  Eigen::VectorXd column_price_;
  std::vector<Eigen::Index> row_of_;  ///< Of each column.
};

using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

/// A measurement as the model has it: M x channels of one step, without the mean of the landmarks,
/// which no permutation changes.
Eigen::MatrixXd step_values(const ObservationHistory& history, Eigen::Index step) {
  const Eigen::ArrayXd values = history.values.col(step).array();
  Eigen::MatrixXd Y;
  if (history.sensor == Sensor::kBearing) {
    Y.resize(values.size(), 2);
    Y << values.cos().matrix(), values.sin().matrix();
  } else if (history.sensor == Sensor::kRange) {
    Y = values.square().matrix();  // affine in the position, but for a term that all steps share
  } else {
    Y = values.matrix();
  }
  return Y.rowwise() - Y.colwise().mean();
}

/// The history as the model has it: an ID is the row of a step's measurements that a landmark has.
struct Identified {
  std::vector<Eigen::MatrixXd> measurements;        ///< Of each step, in the rows of the input.
  std::vector<std::vector<Eigen::Index>> doubtful;  ///< Rows of each step.
  std::vector<std::vector<Eigen::Index>> measurement_of;  ///< Of each landmark, in each step.

  Eigen::MatrixXd values(std::size_t step) const {
    return measurements[step](measurement_of[step], Eigen::all);
  }
};

/// The spread of the values that the components do not explain, and the components.
struct Model {
  Eigen::MatrixXd components;  ///< M x q, orthonormal.
  double loss = 0.0;
};

Model model_of(const Eigen::MatrixXd& gram, Eigen::Index rank) {
  const EigenPairs pairs = largest_eigenpairs(gram, rank);
  return {pairs.vectors, std::max(0.0, gram.trace() - pairs.values.sum())};
}

Model model_of(const Identified& identified, Eigen::Index rank) {
  const Eigen::Index M = identified.measurements.front().rows();
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(M, M);
  for (std::size_t step = 0; step < identified.measurements.size(); ++step) {
    const Eigen::MatrixXd Y = identified.values(step);
    gram.noalias() += Y * Y.transpose();
  }
  return model_of(gram, rank);
}

/// How the IDs of a stretch of steps are assigned.
struct Dealing {
  Eigen::Index stretch = 1;
  double change_cost = 0.0;  ///< For each step and ID that is not the given one.
};

/// Assigns to the doubtful landmarks of the stretch that begins at a step the measurements nearest
/// to their expected values.
/// @param expected  Of each step of the stretch.
/// @return Whether an ID changed.
bool assign(Identified& identified, std::size_t step, const std::vector<Eigen::MatrixXd>& expected,
            double change_cost) {
  const std::vector<Eigen::Index>& rows = identified.doubtful[step];
  const auto d = static_cast<Eigen::Index>(rows.size());
  if (d < 2) return false;
  Eigen::MatrixXd costs =
      Eigen::MatrixXd::Constant(d, d, change_cost * static_cast<double>(expected.size()));
  costs.diagonal().setZero();
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Eigen::MatrixXd wanted = expected[k](rows, Eigen::all);
    const Eigen::MatrixXd read = identified.measurements[step + k](rows, Eigen::all);
    costs.noalias() -= 2.0 * wanted * read.transpose();
    costs.colwise() += wanted.rowwise().squaredNorm();
    costs.rowwise() += read.rowwise().squaredNorm().transpose();
  }
  const std::vector<Eigen::Index> columns = least_assignment(costs);
  // Equal sums must not alternate.
  std::vector<Eigen::Index> position(identified.measurement_of[step].size(), 0);
  for (Eigen::Index k = 0; k < d; ++k)
    position[static_cast<std::size_t>(rows[static_cast<std::size_t>(k)])] = k;
  double found = 0.0;
  double present = 0.0;
  for (Eigen::Index i = 0; i < d; ++i) {
    const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
    found += costs(i, columns[static_cast<std::size_t>(i)]);
    present += costs(i, position[static_cast<std::size_t>(identified.measurement_of[step][row])]);
  }
  if (found >= present - 1e-12 * (1.0 + std::abs(present))) return false;
  for (std::size_t k = 0; k < expected.size(); ++k)
    for (Eigen::Index i = 0; i < d; ++i)
      identified
          .measurement_of[step + k][static_cast<std::size_t>(rows[static_cast<std::size_t>(i)])] =
          rows[static_cast<std::size_t>(columns[static_cast<std::size_t>(i)])];
  return true;
}

/// Assigns the IDs of all stretches. @return Whether one changed.
/// @param expected  The expected values of a step: M x channels.
template <typename Expected>
bool assign_all(Identified& identified, const Dealing& dealing, const Expected& expected) {
  bool changed = false;
  const std::size_t steps = identified.measurements.size();
  const auto stretch = static_cast<std::size_t>(dealing.stretch);
  for (std::size_t step = 0; step < steps; step += stretch) {
    std::vector<Eigen::MatrixXd> wanted;
    for (std::size_t k = step; k < std::min(step + stretch, steps); ++k)
      wanted.push_back(expected(k));
    changed = assign(identified, step, wanted, dealing.change_cost) || changed;
  }
  return changed;
}

/// The median of the squared residuals of the measurements from the components, under the given
/// IDs.
double median_residual(const Identified& identified, Eigen::Index rank) {
  const Eigen::MatrixXd components = model_of(identified, rank).components;
  std::vector<double> squares;
  for (std::size_t step = 0; step < identified.measurements.size(); ++step) {
    const Eigen::MatrixXd Y = identified.values(step);
    const Eigen::VectorXd off =
        (Y - components * (components.transpose() * Y)).rowwise().squaredNorm();
    squares.insert(squares.end(), off.begin(), off.end());
  }
  return upper_median(std::move(squares));
}

/// The doubtful measurements that no exchange within their step would make nearly as likely.
Mask clear_measurements(const Identified& identified, Eigen::Index rank) {
  const Eigen::MatrixXd components = model_of(identified, rank).components;
  const double least = 4.0 * median_residual(identified, rank);
  Mask clear = Mask::Constant(identified.measurements.front().rows(),
                              std::ssize(identified.measurements), false);
  for (std::size_t step = 0; step < identified.measurements.size(); ++step) {
    const std::vector<Eigen::Index>& rows = identified.doubtful[step];
    const Eigen::MatrixXd Y = identified.values(step);
    const Eigen::MatrixXd E = components * (components.transpose() * Y);
    for (const Eigen::Index i : rows) {
      bool is_clear = true;
      for (const Eigen::Index j : rows)
        if (i != j)
          is_clear = is_clear && 2.0 * (E.row(i) - E.row(j)).dot(Y.row(i) - Y.row(j)) > least;
      clear(i, static_cast<Eigen::Index>(step)) = is_clear;
    }
  }
  return clear;
}

/// Alternates between IDs and components until no ID changes.
struct Descent {
  Identified identified;
  double loss = 0.0;
  int rounds = 0;
  bool converged = false;
};

Descent minimized(Identified identified, Eigen::Index rank, int most_rounds,
                  const Dealing& dealing) {
  Descent descent{std::move(identified), 0.0, 0, false};
  Model model = model_of(descent.identified, rank);
  while (!descent.converged && descent.rounds < most_rounds) {
    ++descent.rounds;
    const bool changed = assign_all(descent.identified, dealing, [&](std::size_t step) {
      const Eigen::MatrixXd Y = descent.identified.values(step);
      return Eigen::MatrixXd(model.components * (model.components.transpose() * Y));
    });
    if (changed) model = model_of(descent.identified, rank);
    descent.converged = !changed;
  }
  descent.loss = model.loss;
  return descent;
}

/// The components' prediction of a step from its certain entries alone, shrunk towards the mean so
/// that few entries do not make it extreme.
Eigen::MatrixXd expected_from_certain(const Eigen::MatrixXd& Y, const std::vector<char>& certain,
                                      const Eigen::MatrixXd& components) {
  const Eigen::Index q = components.cols();
  Eigen::MatrixXd A = 1e-2 * Eigen::MatrixXd::Identity(q, q);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(q, Y.cols());
  for (Eigen::Index row = 0; row < Y.rows(); ++row) {
    if (certain[static_cast<std::size_t>(row)] == 0) continue;
    A.noalias() += components.row(row).transpose() * components.row(row);
    b.noalias() += components.row(row).transpose() * Y.row(row);
  }
  return components * A.ldlt().solve(b);
}

/// IDs from the components of the certain entries: the doubtful ones are filled with the
/// components' predictions, iteratively [yairi2007, section 5.1].
Identified from_certain(Identified identified, Eigen::Index rank, const Dealing& dealing) {
  constexpr int kFillings = 15;
  const Eigen::Index M = identified.measurements.front().rows();
  std::vector<Eigen::MatrixXd> filled = identified.measurements;
  std::vector<std::vector<char>> certain(filled.size(),
                                         std::vector<char>(static_cast<std::size_t>(M), 1));
  for (std::size_t step = 0; step < filled.size(); ++step)
    for (const Eigen::Index row : identified.doubtful[step]) {
      certain[step][static_cast<std::size_t>(row)] = 0;
      filled[step].row(row).setZero();
    }
  for (int round = 0; round < kFillings; ++round) {
    Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(M, M);
    for (const Eigen::MatrixXd& Y : filled) gram.noalias() += Y * Y.transpose();
    const Eigen::MatrixXd components = model_of(gram, rank).components;
    for (std::size_t step = 0; step < filled.size(); ++step) {
      if (identified.doubtful[step].empty()) continue;
      const Eigen::MatrixXd expected =
          expected_from_certain(identified.measurements[step], certain[step], components);
      for (const Eigen::Index row : identified.doubtful[step])
        filled[step].row(row) = expected.row(row);
    }
  }
  assign_all(identified, dealing, [&](std::size_t step) { return filled[step]; });
  return identified;
}

Identified identified_history(const ObservationHistory& history, const Mask& doubtful,
                              Eigen::Index stretch) {
  Identified identified;
  for (Eigen::Index step = 0; step < history.steps(); ++step) {
    const Eigen::Index begin = step / stretch * stretch;
    const Eigen::Index count = std::min(stretch, history.steps() - begin);
    identified.measurements.push_back(step_values(history, step));
    std::vector<Eigen::Index> rows;
    std::vector<Eigen::Index> measurement_of;
    for (Eigen::Index row = 0; row < history.landmarks(); ++row) {
      measurement_of.push_back(row);
      if (doubtful.row(row).segment(begin, count).any()) rows.push_back(row);
    }
    identified.doubtful.push_back(std::move(rows));
    identified.measurement_of.push_back(std::move(measurement_of));
  }
  return identified;
}

void check(const ObservationHistory& history, const Mask& doubtful,
           const CorrespondenceOptions& options) {
  if (history.landmarks() < 3 || history.steps() < 1)
    throw InvalidInput("data association needs three landmarks and a step");
  if (doubtful.rows() != history.landmarks() || doubtful.cols() != history.steps())
    throw InvalidInput("the doubtful entries need one flag per entry");
  if (!history.values.allFinite())
    throw InvalidInput("data association needs histories without missing entries");
  if (options.rank < 1 || options.most_rounds < 1 || options.stretch < 1)
    throw InvalidInput("data association needs a rank, rounds and a stretch of 1 or more");
  if (!(options.change_cost >= 0.0 && std::isfinite(options.change_cost)))
    throw InvalidInput("the cost of a changed landmark ID must be finite and not below 0");
}

}  // namespace

std::vector<Eigen::Index> least_assignment(const Eigen::MatrixXd& costs) {
  if (costs.rows() > costs.cols() || !costs.allFinite())
    throw InvalidInput("an assignment needs finite costs and no more rows than columns");
  Assignment assignment(costs);
  for (Eigen::Index row = 0; row < costs.rows(); ++row) assignment.assign(row);
  return assignment.columns();
}

Correspondence estimated_correspondence(const ObservationHistory& history, const Mask& doubtful,
                                        const CorrespondenceOptions& options) {
  check(history, doubtful, options);
  const Eigen::Index rank = std::min(options.rank, history.landmarks() - 1);
  const Identified given = identified_history(history, doubtful, options.stretch);
  Dealing dealing{options.stretch, 0.0};
  if (options.change_cost > 0.0)
    dealing.change_cost = options.change_cost * median_residual(given, rank);
  double spread = 0.0;
  for (const Eigen::MatrixXd& Y : given.measurements) spread += Y.squaredNorm();
  Descent best = minimized(given, rank, options.most_rounds, dealing);
  // Many components would fit the confused IDs too; a few cannot.
  constexpr Eigen::Index kFew = 4;
  if (rank > kFew) {
    Descent other = minimized(given, kFew, options.most_rounds, dealing);
    other = minimized(std::move(other.identified), rank, options.most_rounds, dealing);
    if (other.loss < best.loss) best = std::move(other);
  }
  // Without a certain entry, filling has no start.
  if (!doubtful.all()) {
    Descent other =
        minimized(from_certain(given, rank, dealing), rank, options.most_rounds, dealing);
    if (other.loss < best.loss) best = std::move(other);
  }
  Correspondence result{.history = history,
                        .loss_before = 0.0,
                        .loss_after = 0.0,
                        .rounds = best.rounds,
                        .converged = best.converged};
  result.measurement_of.resize(history.landmarks(), history.steps());
  result.clear = clear_measurements(best.identified, rank);
  if (spread > 0.0) {
    result.loss_before = model_of(given, rank).loss / spread;
    result.loss_after = best.loss / spread;
  }
  for (Eigen::Index step = 0; step < history.steps(); ++step) {
    const auto& measurement_of = best.identified.measurement_of[static_cast<std::size_t>(step)];
    result.history.values.col(step) = history.values.col(step)(measurement_of);
    for (Eigen::Index row = 0; row < history.landmarks(); ++row)
      result.measurement_of(row, step) = measurement_of[static_cast<std::size_t>(row)];
  }
  return result;
}

}  // namespace mapproof
