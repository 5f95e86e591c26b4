#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/observation_history.hpp"
#include "core/model/sensor.hpp"

namespace mapproof {

/// The values of a history, some steps at a time, wherever they are kept: in an array, or packed
/// where an array would be too large.
class HistoryBlocks {
 public:
  /// M x count values, as ObservationHistory has them, of the steps first, first + stride, ...
  using Read =
      std::function<Eigen::MatrixXd(Eigen::Index first, Eigen::Index count, Eigen::Index stride)>;

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
    return read_(first_ + first * stride_, count, stride_);
  }

  /// The steps from `begin` on, before `end`.
  HistoryBlocks between(Eigen::Index begin, Eigen::Index end) const;

  /// One of each `stride` steps, the first among them.
  HistoryBlocks every(Eigen::Index stride) const;

 private:
  Sensor sensor_;
  const std::vector<std::string>* names_;
  Eigen::Index landmarks_;
  Eigen::Index first_ = 0;
  Eigen::Index stride_ = 1;
  Eigen::Index steps_;
  Read read_;
  bool is_complete_ = false;
};

}  // namespace mapproof
