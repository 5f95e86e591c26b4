#pragma once

#include <string>
#include <vector>

#include "core/model/detection_log.hpp"

namespace mapproof {

/// Scans of several robots as they come, pooled as a file of all of them would be: robot by robot,
/// each robot's in order of step or time.
class IncrementalLog {
 public:
  /// Adds a scan; robots are numbered as they come.
  /// @param detections  Ascending by landmark, none twice; their steps are not read.
  /// @throws InvalidInput unless the robot's scans come in ascending order.
  void add(const ScanKey& scan, const std::vector<Detection>& detections);

  int steps() const { return steps_; }

  /// The log so far, and the scans that its steps are.
  /// @param is_timed  Scans go by time: the log holds it.
  /// @note O(detections).
  DetectionLog log(const std::vector<std::string>& names, bool is_timed) const;
  std::vector<ScanKey> scans() const;

 private:
  struct Robot {
    std::vector<double> keys;
    std::vector<Detection> detections;  ///< Their steps are the robot's own.
  };

  std::vector<Robot> robots_;
  int steps_ = 0;
};

}  // namespace mapproof
