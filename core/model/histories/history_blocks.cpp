#include "core/model/histories/history_blocks.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "core/base/not_finite.hpp"

namespace mapproof {

using Eigen::Index;

namespace {

using Names = std::vector<std::string>;

/// Names that somebody else keeps.
std::shared_ptr<const Names> kept(const Names& names) {
  return {std::shared_ptr<const Names>(), &names};
}

}  // namespace

HistoryBlocks::HistoryBlocks(const ObservationHistory& history)
    : sensor_(history.sensor),
      names_(kept(history.names)),
      landmarks_(history.landmarks()),
      steps_(history.steps()),
      read_([&values = history.values](const Part& part) {
        using Strided = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
        return Eigen::MatrixXd(
            Strided(values.data() + part.first * values.rows() + part.first_row, part.rows,
                    part.count, Eigen::OuterStride<>(part.stride * values.rows())));
      }) {}

HistoryBlocks::HistoryBlocks(Sensor sensor, const Names& names, Index steps, Read read,
                             bool is_complete)
    : sensor_(sensor),
      names_(kept(names)),
      landmarks_(std::ssize(names)),
      steps_(steps),
      read_(std::move(read)),
      is_complete_(is_complete) {}

HistoryBlocks HistoryBlocks::between(Index begin, Index end) const {
  HistoryBlocks part = *this;
  part.first_ = first_ + begin * stride_;
  part.steps_ = end - begin;
  return part;
}

HistoryBlocks HistoryBlocks::every(Index stride) const {
  HistoryBlocks part = *this;
  part.stride_ = stride_ * stride;
  part.steps_ = (steps_ + stride - 1) / stride;
  return part;
}

HistoryBlocks HistoryBlocks::only(std::vector<Index> rows) const {
  HistoryBlocks some = *this;
  if (std::ssize(rows) == landmarks_) return some;
  auto names = std::make_shared<Names>();
  for (const Index row : rows) names->push_back((*names_)[static_cast<std::size_t>(row)]);
  some.names_ = std::move(names);
  some.landmarks_ = std::ssize(rows);
  some.read_ = [all = read_, rows = std::move(rows)](Part part) {
    if (part.rows == 0) return Eigen::MatrixXd(0, part.count);
    const auto first = static_cast<std::size_t>(part.first_row);
    const auto count = static_cast<std::size_t>(part.rows);
    part.first_row = rows[first];
    part.rows = rows[first + count - 1] + 1 - part.first_row;
    const Eigen::MatrixXd values = all(part);
    Eigen::MatrixXd chosen(static_cast<Index>(count), part.count);
    for (Index i = 0; i < chosen.rows(); ++i)
      chosen.row(i) = values.row(rows[first + static_cast<std::size_t>(i)] - part.first_row);
    return chosen;
  };
  return some;
}

ObservationHistory array_of(const HistoryBlocks& history) {
  return {.sensor = history.sensor(),
          .names = history.names(),
          .values = history.values(0, history.steps())};
}

HistoryBlocks blocks_of(const DetectionLog& log, Sensor sensor) {
  // The detections of each step.
  auto begins = std::make_shared<std::vector<std::size_t>>(static_cast<std::size_t>(log.steps) + 1);
  for (const Detection& seen : log.detections) ++(*begins)[static_cast<std::size_t>(seen.step) + 1];
  for (std::size_t step = 1; step < begins->size(); ++step) (*begins)[step] += (*begins)[step - 1];
  const auto read = [&log, sensor, begins](const HistoryBlocks::Part& part) {
    Eigen::MatrixXd values = Eigen::MatrixXd::Constant(
        part.rows, part.count, sensor == Sensor::kVisibility ? 0.0 : kNaN);
    for (Index t = 0; t < part.count; ++t) {
      const auto step = static_cast<std::size_t>(part.first + t * part.stride);
      const std::span scan(log.detections.data() + (*begins)[step],
                           (*begins)[step + 1] - (*begins)[step]);
      const auto seen = std::ranges::lower_bound(scan, part.first_row, {}, &Detection::landmark);
      const auto end = std::ranges::lower_bound(seen, scan.end(), part.first_row + part.rows, {},
                                                &Detection::landmark);
      for (const Detection& one : std::span(seen, end))
        values(one.landmark - part.first_row, t) = measured(one, sensor);
    }
    return values;
  };
  return {sensor, log.names, log.steps, read, sensor == Sensor::kVisibility};
}

}  // namespace mapproof
