#pragma once

#include <optional>
#include <vector>

#include "core/association/identified_scans.hpp"
#include "core/association/robust_map.hpp"
#include "core/association/scan_costs.hpp"

namespace mapproof {

/// The fault that reduces the cost of a map the most; empty if none does. The best of each type is
/// refined to single scans before they are compared: whole blocks favour now one, now the other.
/// @param ids  The current landmark ID of each detection.
/// @param map  Of the pairs under these IDs.
std::optional<HypothesisFit> best_fit(const IdentifiedScans& scans, const std::vector<int>& ids,
                                      const RobustMap& map);

/// Single detections under one ID that are of another landmark, at any time: those that cost more
/// than chance explains, and less than half as much under the other ID.
/// @return The two IDs for which that gains the most; empty if there is no such detection.
/// @note O(M P) time for M landmarks and P pairs, and 8 M bytes per detection.
std::optional<HypothesisFit> mixed_fit(const IdentifiedScans& scans, const std::vector<int>& ids,
                                       const RobustMap& map);

/// Two IDs that are swapped, or one given in place of the other, in single scans at any time: found
/// by the two positions that both IDs' detections share, then refined scan by scan.
///
/// The scans do not determine which position belongs to which ID: it is chosen so that one ID alone
/// is at fault, or else so that fewer detections are.
/// @param map  Of the pairs under these IDs; the hypothesis' cost is at its width.
/// @return The one of the least cost; empty if no two IDs share positions.
/// @note Some 1 s for 15 landmarks.
std::optional<HypothesisFit> scattered_fit(const IdentifiedScans& scans,
                                           const std::vector<int>& ids, const RobustMap& map);

/// For a swap that changes the detections under one ID alone: the fault of that ID, if it explains
/// as much.
HypothesisFit plainest(const IdentifiedScans& scans, const std::vector<int>& ids,
                       HypothesisFit fit);

}  // namespace mapproof
