#pragma once

#include <string>
#include <vector>

#include "core/embed/embedder.hpp"

namespace mapproof {

/// What a person wants done about missing entries.
struct MissingChoice {
  std::string way = "common-steps";  ///< One of missing_ways().
  std::optional<int> dimensions;     ///< Of PPCA or PCA.
};

/// "common-steps", "ppca", "pca", "covisible": as the command line has them.
std::vector<std::string> missing_ways();

/// What came of it, beside the map.
struct MissingOutcome {
  std::vector<Status> statuses;
  std::vector<std::string> remarks;
};

/// From observations to proximities as it was chosen; empty: as always.
/// @param outcome  Filled once the rule is called; must outlive it.
/// @throws InvalidInput for a way that does not fit the sensor, or dimensions of a way without.
ProximityRule proximity_rule(const MissingChoice& choice, Sensor sensor, MissingOutcome& outcome);

}  // namespace mapproof
