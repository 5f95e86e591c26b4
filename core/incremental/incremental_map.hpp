#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/association/moved.hpp"
#include "core/embed/embedder.hpp"
#include "core/model/detection_log.hpp"
#include "core/model/sensor.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// One landmark in one step.
struct StepEntry {
  Eigen::Index landmark = 0;
  double value = 0.0;  ///< 0 or 1, rad, or m; finite.
};

/// The sums over steps that determine the proximities of observation histories, so that one more
/// step costs only its own pairs of landmarks, however many there were before.
class PairSums {
 public:
  explicit PairSums(Sensor sensor) : sensor_(sensor) {}

  /// The number of landmarks from now on: unobserved ones are added.
  /// @throws InvalidInput for fewer than before.
  /// @note Memory up to 32 n^2 bytes for n landmarks, four times that while their number grows.
  void grow(Eigen::Index landmarks);

  /// Adds a step; landmarks that it does not list were not observed.
  /// @throws InvalidInput for an unknown landmark, one listed twice, or a value that is not finite.
  /// @note O(k^2) for k landmarks listed.
  void add(const std::vector<StepEntry>& step);

  Eigen::Index landmarks() const { return landmarks_; }
  Eigen::Index steps() const { return steps_; }

  /// Landmarks with any observation, ascending: see unseen_landmarks().
  std::vector<Eigen::Index> seen() const;

  /// The proximities of some seen landmarks: those of proximities() of all steps, but for rounding.
  /// Where visibility lists detections alone, unlisted landmarks count as not seen.
  /// @note O(n^2) for n rows.
  Proximities proximities_of(const std::vector<Eigen::Index>& rows) const;

 private:
  void add_bearings(const std::vector<StepEntry>& entries);
  void add_values(const std::vector<StepEntry>& entries);
  double count(Eigen::Index i, Eigen::Index j) const;
  double centred_product(Eigen::Index i, Eigen::Index j) const;
  double centred_square(Eigen::Index i, Eigen::Index j) const;

  Sensor sensor_;
  Eigen::Index landmarks_ = 0;  ///< The matrices have room for more.
  Eigen::Index steps_ = 0;
  bool lists_detections_ = true;  ///< Visibility: no 0 was listed so far.
  // Entry (i, j) is over the steps that list both. Symmetric ones are kept below the diagonal, and
  // those that a sensor does not need are empty.
  Eigen::MatrixXd products_;  ///< i >= j: of i's value and j's; cosines of differences of bearings.
  Eigen::MatrixXd counts_;    ///< i >= j: steps.
  Eigen::MatrixXd squares_;   ///< Of i's; not of bearings.
  Eigen::MatrixXd values_;    ///< Ranges: i's squared range, less the first.
  Eigen::VectorXd first_;     ///< Ranges: i's first squared range, against cancellation.
};

struct IncrementalOptions {
  MethodSetting setting;  ///< Without a parameter: the usual one at each update.
  EmbedderOptions embedder;
};

/// How near every update is to the map of the whole history: see relative_gap(). The proximities
/// are the same but for rounding, and so are the computations with them.
inline constexpr double kIncrementalWithin = 1e-6;

/// One state of an incremental map.
struct IncrementalUpdate {
  Embedding embedding;    ///< M x 2; NaN rows: not observed so far.
  MethodSetting setting;  ///< With its parameter.
};

/// An incremental map of observations that arrive in time. A step costs its pairs; an update costs
/// O(M^2) and the method's own time, independent of the number of steps.
///
/// Each update is the map of the whole history by the same method, within kIncrementalWithin: it
/// has the same start. To continue from the last map would save iterations, but stress has several
/// minima, and no available test determines which of them the whole history leads to.
class IncrementalMap {
 public:
  IncrementalMap(Sensor sensor, IncrementalOptions options) : options_(options), sums_(sensor) {}

  void grow(Eigen::Index landmarks) { sums_.grow(landmarks); }
  void add(const std::vector<StepEntry>& step) { sums_.add(step); }
  Eigen::Index landmarks() const { return sums_.landmarks(); }
  Eigen::Index steps() const { return sums_.steps(); }

  /// The map of all steps so far.
  IncrementalUpdate update() const;

 private:
  IncrementalOptions options_;
  PairSums sums_;
};

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
