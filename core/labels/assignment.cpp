#include "core/labels/assignment.hpp"

#include <limits>

#include "core/base/errors.hpp"

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
    Eigen::VectorXd reach = Eigen::VectorXd::Constant(m, std::numeric_limits<double>::infinity());
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

}  // namespace

std::vector<Eigen::Index> least_assignment(const Eigen::MatrixXd& costs) {
  if (costs.rows() > costs.cols() || !costs.allFinite())
    throw InvalidInput("an assignment needs finite costs and no more rows than columns");
  Assignment assignment(costs);
  for (Eigen::Index row = 0; row < costs.rows(); ++row) assignment.assign(row);
  return assignment.columns();
}

}  // namespace mapproof
