#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/embed/embedder.hpp"

namespace mapproof {

/// What a person wants done about missing entries.
struct MissingChoice {
  std::string way = "common-steps";  ///< One of missing_ways(), or "auto".
  std::optional<int> dimensions;     ///< Of PPCA or PCA.
};

/// "common-steps", "ppca", "pca", "covisible", "auto": as the command line has them.
std::vector<std::string> missing_ways();

/// What came of it, beside the map.
struct MissingOutcome {
  std::vector<Status> statuses;
  std::vector<std::string> remarks;
  std::vector<std::string> warnings;
  bool told = false;  ///< The remark on what was filled in or left out is there.
  /// What is to be said of pairs without a distance, if it is not that they share no step.
  std::optional<Status> completed;
};

/// What the pattern of the gaps advises against in what was chosen, and, for "auto", the choice.
/// Entries that are all there, or too many to be judged in short, are not judged.
/// @param history  Landmarks that were never observed count for nothing.
/// @return The choice with a way to be taken.
MissingChoice judged_choice(MissingChoice choice, const ObservationHistory& history,
                            Eigen::Index steps, MissingOutcome& outcome);

/// From observations to proximities as it was chosen; empty: as always.
/// @param outcome  Filled once the rule is called; must outlive it.
/// @param choice  Not "auto" (see judged_choice).
/// @throws InvalidInput for a way that does not fit the sensor, or dimensions of a way without.
ProximityRule proximity_rule(const MissingChoice& choice, Sensor sensor, MissingOutcome& outcome);

}  // namespace mapproof
