#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/embed/embedder.hpp"
#include "core/model/sensor.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// One landmark in one step.
struct StepEntry {
  Eigen::Index landmark = 0;
  double value = 0.0;  ///< 0 or 1, rad, or m; finite.
};

/// The sums over steps from which the proximities of observation histories follow, so that a step
/// more costs what its own pairs of landmarks cost, however many there were before.
class PairSums {
 public:
  explicit PairSums(Sensor sensor) : sensor_(sensor) {}

  /// Landmarks from now on: so far unobserved ones come to those there are.
  /// @throws InvalidInput for fewer than there are.
  /// @note Memory up to 32 n^2 bytes for n landmarks, four times that while they become more.
  void grow(Eigen::Index landmarks);

  /// Adds a step; landmarks that it does not list were not observed.
  /// @throws InvalidInput for a landmark that is none, is listed twice, or whose value is not
  ///         finite.
  /// @note O(k^2) for k landmarks listed.
  void add(const std::vector<StepEntry>& step);

  Eigen::Index landmarks() const { return landmarks_; }
  Eigen::Index steps() const { return steps_; }

  /// Landmarks about which something was observed, ascending: see unseen_landmarks().
  std::vector<Eigen::Index> seen() const;

  /// The proximities of some landmarks that were seen: those of proximities() of all steps, but for
  /// rounding. Where visibility lists detections alone, what is not listed counts as not seen.
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
  // Entry (i, j) is over the steps that list both. Those that are the same both ways are kept below
  // the diagonal, and what a sensor has no use for is empty.
  Eigen::MatrixXd products_;  ///< i >= j: of i's value and j's; cosines of differences of bearings.
  Eigen::MatrixXd counts_;    ///< i >= j: steps.
  Eigen::MatrixXd squares_;   ///< Of i's; not of bearings.
  Eigen::MatrixXd values_;    ///< Ranges: i's squared range, less the first.
  Eigen::VectorXd first_;     ///< Ranges: i's first squared range, against cancellation.
};

struct FollowOptions {
  MethodSetting setting;  ///< Without a parameter: the usual one at each update.
  EmbedderOptions embedder;
};

/// How near every update is to the map of the whole history: see relative_gap(). The proximities
/// are the same but for rounding, and so is what is done with them.
inline constexpr double kFollowedWithin = 1e-6;

/// One state of a map that grows.
struct FollowedUpdate {
  Embedding embedding;    ///< M x 2; NaN rows: not observed so far.
  MethodSetting setting;  ///< With its parameter.
};

/// A map of observations that arrive in time. A step costs its pairs; an update O(M^2) and what the
/// method takes, whatever the number of steps.
///
/// Each update is the map of the whole history by the same method, within kFollowedWithin: it
/// begins where that begins. Going on from the last map instead would save iterations, but stress
/// has several minima, and no test at hand tells which of them the whole history leads to.
class IncrementalMap {
 public:
  IncrementalMap(Sensor sensor, FollowOptions options) : options_(options), sums_(sensor) {}

  void grow(Eigen::Index landmarks) { sums_.grow(landmarks); }
  void add(const std::vector<StepEntry>& step) { sums_.add(step); }
  Eigen::Index landmarks() const { return sums_.landmarks(); }
  Eigen::Index steps() const { return sums_.steps(); }

  /// The map of all steps so far.
  FollowedUpdate update() const;

 private:
  FollowOptions options_;
  PairSums sums_;
};

}  // namespace mapproof
