#pragma once

#include <string>
#include <vector>

#include "core/association/moved.hpp"
#include "core/model/detection_log.hpp"

namespace mapproof {

/// Scans of several robots as they arrive, pooled as a file of all of them would be: robot by
/// robot, each robot's in order of step or time.
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

/// A landmark that was found to have moved while scans still arrive.
struct NoticedMove {
  MovedLandmark found;  ///< In the scans of the check.
  ScanKey from;         ///< The first detection at the new position.
};

/// Looks for moved landmarks in a log that grows, and keeps their later detections apart.
///
/// A check is find_moved() of all scans so far, made when there are a quarter more of them than at
/// the last: by then a move right after it is visible for long enough. So that all checks together
/// report a move in hardly more than `level` of the logs without one, the k-th has a level of level
/// / (k (k + 1)).
class MovedWatch {
 public:
  explicit MovedWatch(const MovedOptions& options = {}) : options_(options) {}

  /// Whether there are scans enough for the next check.
  bool is_due(int steps) const { return steps >= next_; }

  /// Checks. @return New findings. @note As find_moved().
  std::vector<NoticedMove> check(const IncrementalLog& scans, const DetectionLog& log);

  /// The log with two landmarks for each one found, "NAME (moved)" the later one.
  DetectionLog split(const IncrementalLog& scans, DetectionLog log) const;

  const std::vector<NoticedMove>& moved() const { return moved_; }

 private:
  MovedOptions options_;
  int checks_ = 0;
  int next_ = 60;
  std::vector<NoticedMove> moved_;
};

}  // namespace mapproof
