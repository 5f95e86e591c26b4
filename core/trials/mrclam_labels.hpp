#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/model/points.hpp"

namespace mapproof {

/// Real scans some of whose labels were made wrong.
struct SpoiltLabels {
  std::string id;  ///< "swapped", "misnamed".
  DetectionLog log;
};

/// Two labels swapped in half of the scans, drawn at random; and one landmark called by another's
/// name in all of them. The landmarks are among those seen most: so the fault weighs.
/// @return None of fewer than 6 landmarks.
std::vector<SpoiltLabels> spoilt_labels(const DetectionLog& log, std::uint64_t seed);

/// How much was found wrong, and the log without it.
struct CorrectedLabels {
  int faults = 0;
  DetectionLog log;
};

/// Labels that contradict one another, that two landmarks bear, or that known places contradict,
/// corrected as `mapproof map --repair-ids` does.
/// @param known_m  M x 2; empty: no place is known.
CorrectedLabels corrected_log(const DetectionLog& log, const std::optional<Points>& known_m);

}  // namespace mapproof
