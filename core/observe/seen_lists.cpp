#include "core/observe/seen_lists.hpp"

#include <numeric>

#include "core/base/errors.hpp"
#include "core/graph/disjoint_sets.hpp"
#include "core/observe/bit_rows.hpp"

namespace mapproof {

using Eigen::Index;

/// @param for_each_seen  Calls its argument with landmark and step of each that was seen, ascending
///                       in steps or in landmarks; it is called twice.
template <typename ForEachSeen>
void SeenLists::fill(Index landmarks, Index steps, const ForEachSeen& for_each_seen) {
  steps_.first.resize(static_cast<std::size_t>(landmarks) + 1);
  landmarks_.first.resize(static_cast<std::size_t>(steps) + 1);
  for_each_seen([&](Index i, Index t) {
    ++steps_.first[static_cast<std::size_t>(i) + 1];
    ++landmarks_.first[static_cast<std::size_t>(t) + 1];
  });
  for (Lists* lists : {&steps_, &landmarks_}) {
    std::partial_sum(lists->first.begin(), lists->first.end(), lists->first.begin());
    lists->members.resize(lists->first.back());
  }
  std::vector<std::size_t> next_step = steps_.first, next_landmark = landmarks_.first;
  for_each_seen([&](Index i, Index t) {
    steps_.members[next_step[static_cast<std::size_t>(i)]++] = static_cast<std::int32_t>(t);
    landmarks_.members[next_landmark[static_cast<std::size_t>(t)]++] = static_cast<std::int32_t>(i);
  });
}

SeenLists::SeenLists(const HistoryBlocks& history, Index steps) {
  const BitRows seen = history_bits(history, steps).seen;
  fill(history.landmarks(), steps, [&](const auto& take) {
    for (Index i = 0; i < seen.rows(); ++i) seen.for_each_one(i, [&](Index t) { take(i, t); });
  });
}

SeenLists::SeenLists(const DetectionLog& log) {
  const auto M = static_cast<Index>(log.names.size());
  for (const Detection& one : log.detections)
    if (one.landmark < 0 || one.landmark >= M || one.step < 0 || one.step >= log.steps)
      throw InvalidInput("a detection names a landmark or a step that its log does not have");
  fill(M, log.steps, [&](const auto& take) {
    for (const Detection& one : log.detections) take(one.landmark, one.step);
  });
}

bool is_sparse_visibility(const HistoryBlocks& history, Index steps) {
  if (history.sensor() != Sensor::kVisibility) return false;
  if (const HistoryBits bits = history_bits(history, steps); !bits.are_all || bits.misses_any)
    return false;
  double products = 0.0;
  for_blocks(history, steps, [&](Index, const Eigen::MatrixXd& values) {
    for (Index t = 0; t < values.cols(); ++t) {
      const auto seen = static_cast<double>((values.col(t).array() > 0.0).count());
      products += seen * seen;
    }
  });
  const auto M = static_cast<double>(history.landmarks());
  // Measured: a landmark of a list takes as long as 256 entries as bits.
  return 256.0 * products < M * M * static_cast<double>(steps);
}

int SeenLists::groups() const {
  DisjointSets sets(static_cast<std::size_t>(landmarks()));
  auto groups = static_cast<int>(landmarks());
  for (std::size_t step = 0; step < static_cast<std::size_t>(steps()); ++step)
    for (const std::int32_t landmark : landmarks_of(step))
      if (sets.merge(static_cast<std::size_t>(landmark),
                     static_cast<std::size_t>(landmarks_of(step).front())))
        --groups;
  return groups;
}

}  // namespace mapproof
