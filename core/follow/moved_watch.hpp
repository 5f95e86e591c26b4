#pragma once

#include <vector>

#include "core/follow/incremental_log.hpp"
#include "core/labels/moved.hpp"

namespace mapproof {

/// A landmark that was noticed to have moved, while scans still came.
struct NoticedMove {
  MovedLandmark found;  ///< In the scans of the check.
  ScanKey from;         ///< The first detection at the new place.
};

/// Looks for landmarks that moved in a log that grows, and keeps their later detections apart.
///
/// A check is find_moved() of all scans so far, made when there are a quarter more of them than at
/// the last: by then a move right after it holds long enough to tell. So that all the checks
/// together say of hardly more than `level` of logs without a move that something moved, the k-th
/// has a level of level / (k (k + 1)).
class MovedWatch {
 public:
  explicit MovedWatch(const MovedOptions& options = {}) : options_(options) {}

  /// Whether there are scans enough for the next check.
  bool is_due(int steps) const { return steps >= next_; }

  /// Checks. @return What was not noticed before. @note As find_moved().
  std::vector<NoticedMove> check(const IncrementalLog& scans, const DetectionLog& log);

  /// The log with two landmarks for each that was noticed, "NAME (moved)" the later one.
  DetectionLog split(const IncrementalLog& scans, DetectionLog log) const;

  const std::vector<NoticedMove>& moved() const { return moved_; }

 private:
  MovedOptions options_;
  int checks_ = 0;
  int next_ = 60;
  std::vector<NoticedMove> moved_;
};

}  // namespace mapproof
