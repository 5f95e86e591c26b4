#pragma once

#include <optional>
#include <vector>

#include "core/embed/embedder.hpp"
#include "core/follow/pair_sums.hpp"

namespace mapproof {

struct FollowOptions {
  MethodSetting setting;  ///< Without a parameter: the usual one at each update.
  EmbedderOptions embedder;
  /// SMACOF with equal weights goes on from its last map, for at most so many updates before it is
  /// begun anew, too, >= 1.
  int whole_every = 20;
};

/// How near a map that goes on is to that of the whole history: see relative_gap().
inline constexpr double kFollowedWithin = 0.01;

/// One state of a map that grows.
struct FollowedUpdate {
  Embedding embedding;    ///< M x 2; NaN rows: not observed so far.
  MethodSetting setting;  ///< With its parameter.
  bool whole = true;      ///< Begun anew, as if there had been no update before.
  /// Of a whole one that had a warm one beside it: how far apart they were, see relative_gap().
  std::optional<double> gap;
};

/// A map of observations that arrive in time. A step costs its pairs; an update O(M^2) and what the
/// method takes, whatever the number of steps.
///
/// Every method but SMACOF with equal weights gives what it gives of the whole history, but for
/// rounding. SMACOF goes on from its last map, by the same stop rule, while that leads to the map
/// of the whole history: whole updates hold both against each other. As long as they are within
/// kFollowedWithin, twice as many updates as before go on until the next whole one, up to
/// `whole_every`; where they are not, as of stress with several minima, every update is whole until
/// they are again.
class FollowedMap {
 public:
  FollowedMap(Sensor sensor, FollowOptions options);

  void grow(Eigen::Index landmarks) { sums_.grow(landmarks); }
  void add(const std::vector<StepEntry>& step) { sums_.add(step); }
  Eigen::Index landmarks() const { return sums_.landmarks(); }
  Eigen::Index steps() const { return sums_.steps(); }

  /// @param whole  Begin anew whatever the count says, as for the last map of all.
  FollowedUpdate update(bool whole = false);

 private:
  std::optional<Embedding> warm(const Proximities& proximities,
                                const std::vector<Eigen::Index>& seen) const;

  FollowOptions options_;
  PairSums sums_;
  std::optional<Points> last_;  ///< Of the landmarks seen at the last update.
  std::vector<Eigen::Index> last_seen_;
  int trusted_ = 0;      ///< Updates that may go on after a whole one.
  int since_whole_ = 0;  ///< That went on.
};

}  // namespace mapproof
