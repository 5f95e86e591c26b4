#pragma once

#include <string>
#include <vector>

#include "core/model/sighting_log.hpp"

namespace mapproof {

/// Looks of several robots as they come, pooled as a file of all of them would be: robot by robot,
/// each robot's in order of step or time.
class FollowedLog {
 public:
  /// Adds a look; robots are numbered as they come.
  /// @param sightings  Ascending by landmark, none twice; their steps are not read.
  /// @throws InvalidInput unless the robot's looks come in ascending order.
  void add(const LookKey& look, const std::vector<Sighting>& sightings);

  int steps() const { return steps_; }

  /// The log so far, and the looks that its steps are.
  /// @param is_timed  Looks go by time: the log holds it.
  /// @note O(sightings).
  SightingLog log(const std::vector<std::string>& names, bool is_timed) const;
  std::vector<LookKey> looks() const;

 private:
  struct Robot {
    std::vector<double> keys;
    std::vector<Sighting> sightings;  ///< Their steps are the robot's own.
  };

  std::vector<Robot> robots_;
  int steps_ = 0;
};

}  // namespace mapproof
