#pragma once

#include <cstddef>
#include <vector>

#include "core/model/sighting_log.hpp"

namespace mapproof {

/// Two sightings of one look that measured range and bearing both: their distance needs no pose.
struct LookPair {
  int step = 0;
  std::size_t first = 0;  ///< Row among the log's sightings; first < second.
  std::size_t second = 0;
  double distance_m = 0.0;  ///< By the law of cosines.
};

/// All pairs of sightings in one look, by step.
///
/// Of more than `most` those of every second, third, ... look that shows any.
/// @throws InvalidInput if a sighting names no landmark or no step of the log, steps descend, or a
///         value is infinite.
/// @note Linear in sightings and pairs.
std::vector<LookPair> look_pairs(const SightingLog& log, std::size_t most = 2'000'000);

/// The landmark that each sighting of the log names: what may be doubted.
std::vector<int> given_labels(const SightingLog& log);

}  // namespace mapproof
