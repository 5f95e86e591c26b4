#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model/points.hpp"
#include "core/model/sighting_log.hpp"

namespace mapproof {

/// Real looks some of whose labels were made wrong.
struct SpoiltLabels {
  std::string id;  ///< "swapped", "misnamed".
  SightingLog log;
};

/// Two labels swapped in half of the looks, drawn at random; and one landmark called by another's
/// name in all of them. The landmarks are among those seen most: so the fault weighs.
/// @return None of fewer than 6 landmarks.
std::vector<SpoiltLabels> spoilt_labels(const SightingLog& log, std::uint64_t seed);

/// How much was found wrong, and the log without it.
struct MendedLabels {
  int faults = 0;
  SightingLog log;
};

/// Labels that contradict one another, that two landmarks bear, or that known places contradict,
/// mended as `mapproof map --repair-labels` does.
/// @param known_m  M x 2; empty: no place is known.
MendedLabels mended_log(const SightingLog& log, const std::optional<Points>& known_m);

}  // namespace mapproof
