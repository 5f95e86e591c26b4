#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/detection_log.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/sensor.hpp"

namespace mapproof {

/// The values of a history, some landmarks and steps at a time, wherever they are kept: in an
/// array, or packed or as a list where an array would be too large.
class HistoryBlocks {
 public:
  /// The landmarks from `first_row` on, at the steps first, first + stride, ...
  struct Part {
    Eigen::Index first_row, rows;
    Eigen::Index first, count, stride;
  };
  /// rows x count values, as ObservationHistory has them.
  using Read = std::function<Eigen::MatrixXd(const Part& part)>;

  /// @param history  Must outlive the object.
  HistoryBlocks(const ObservationHistory& history);  // NOLINT(google-explicit-constructor)

  /// @param names        Of the landmarks; must outlive the object.
  /// @param is_complete  No value is missing.
  HistoryBlocks(Sensor sensor, const std::vector<std::string>& names, Eigen::Index steps, Read read,
                bool is_complete);

  Sensor sensor() const { return sensor_; }
  const std::vector<std::string>& names() const { return *names_; }
  Eigen::Index landmarks() const { return landmarks_; }
  Eigen::Index steps() const { return steps_; }
  /// True only if it is known beforehand that no value is missing.
  bool is_complete() const { return is_complete_; }

  /// M x count. @param first, count  Within the steps.
  Eigen::MatrixXd values(Eigen::Index first, Eigen::Index count) const {
    return values_of(0, landmarks_, first, count);
  }

  /// rows x count. @param first_row, rows  Within the landmarks.
  Eigen::MatrixXd values_of(Eigen::Index first_row, Eigen::Index rows, Eigen::Index first,
                            Eigen::Index count) const {
    return read_({first_row, rows, first_ + first * stride_, count, stride_});
  }

  /// The steps from `begin` on, before `end`.
  HistoryBlocks between(Eigen::Index begin, Eigen::Index end) const;

  /// One of each `stride` steps, the first among them.
  HistoryBlocks every(Eigen::Index stride) const;

  /// Some landmarks alone. @param rows  Ascending.
  HistoryBlocks only(std::vector<Eigen::Index> rows) const;

 private:
  Sensor sensor_;
  std::shared_ptr<const std::vector<std::string>> names_;  ///< Owned where it is a part of them.
  Eigen::Index landmarks_;
  Eigen::Index first_ = 0;
  Eigen::Index stride_ = 1;
  Eigen::Index steps_;
  Read read_;
  bool is_complete_ = false;
};

/// Of fewer steps a map is reported: one scan puts all bearings on a circle, two on a torus.
inline constexpr Eigen::Index kFewestSteps = 3;

/// Steps that are taken together where values are read in blocks: their vectors fit the last cache.
inline constexpr Eigen::Index kStepsAtATime = 4096;

/// The same of many landmarks: fewer, so that a block takes 128 MB. A multiple of 64.
inline Eigen::Index steps_at_a_time(Eigen::Index landmarks) {
  constexpr Eigen::Index kBlockEntries = Eigen::Index{1} << 24, kWord = 64;
  const Eigen::Index steps = kBlockEntries / std::max<Eigen::Index>(landmarks, 1) / kWord * kWord;
  return std::clamp(steps, kWord, kStepsAtATime);
}

/// Calls take(first, values) for the first `steps` observations, some of them at a time.
template <typename Take>
void for_blocks(const HistoryBlocks& history, Eigen::Index steps, const Take& take) {
  const Eigen::Index count = steps_at_a_time(history.landmarks());
  for (Eigen::Index first = 0; first < steps; first += count)
    take(first, history.values(first, std::min(count, steps - first)));
}

/// All values as an array.
ObservationHistory array_of(const HistoryBlocks& history);

/// What one sensor observed in those scans, as history_of() has it.
/// @param log  Must outlive the object.
/// @note Reading takes the time of the detections of those landmarks, and O(log k) a scan of k.
HistoryBlocks blocks_of(const DetectionLog& log, Sensor sensor);

}  // namespace mapproof
