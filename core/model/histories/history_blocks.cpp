#include "core/model/histories/history_blocks.hpp"

#include <utility>

namespace mapproof {

using Eigen::Index;

HistoryBlocks::HistoryBlocks(const ObservationHistory& history)
    : sensor_(history.sensor),
      names_(&history.names),
      landmarks_(history.landmarks()),
      steps_(history.steps()),
      read_([&values = history.values](Index first, Index count, Index stride) {
        using Strided = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
        return Eigen::MatrixXd(Strided(values.data() + first * values.rows(), values.rows(), count,
                                       Eigen::OuterStride<>(stride * values.rows())));
      }) {}

HistoryBlocks::HistoryBlocks(Sensor sensor, const std::vector<std::string>& names, Index steps,
                             Read read, bool is_complete)
    : sensor_(sensor),
      names_(&names),
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

}  // namespace mapproof
