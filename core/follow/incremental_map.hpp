#pragma once

#include <vector>

#include "core/embed/embedder.hpp"
#include "core/follow/pair_sums.hpp"

namespace mapproof {

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
