#pragma once

#include <vector>

#include "core/model/detection_log.hpp"
#include "core/model/points.hpp"

namespace mapproof {

/// The fewest known positions that reveal exchanged landmark IDs: a similarity fits any two.
inline constexpr int kFewestKnownPositions = 4;

/// Two landmark IDs that are exchanged in all detections.
struct AnchorExchange {
  int first = 0;                 ///< A landmark with a known position,
  int second = 0;                ///< and another one, known or not.
  double misfit_before_m = 0.0;  ///< Of all known positions, as in AnchorCheck,
  double misfit_after_m = 0.0;   ///< and with this exchange corrected.
};

/// What the known positions of some landmarks show about the landmark IDs.
struct AnchorCheck {
  int positions = 0;                      ///< Known, of landmarks on the map.
  std::vector<AnchorExchange> exchanges;  ///< In the order found, the clearest first.
  double misfit_before_m = 0.0;  ///< Root mean square distance of the map from the known positions,
  double misfit_after_m = 0.0;   ///< after a robust similarity that gives outliers little weight.
  DetectionLog repaired;         ///< The log with the exchanges corrected.
};

/// Looks for landmark IDs that are exchanged throughout: pairs cannot show it, known positions can.
///
/// An exchange is reported only if it explains the known positions by 30 variances better than the
/// given IDs do, and by 10 better than any other exchange in its stead; at most one for
/// kFewestKnownPositions positions, and one more for each two beyond. check_association finds
/// exchanges over a part of the log: correct them first.
/// @param known_m  M x 2; NaN rows: not known.
/// @throws InvalidInput if known_m does not have one row per landmark, or as scan_pairs does.
/// @note O(k M) fits of k positions, of those 40 known ones that fit worst.
AnchorCheck check_anchor_ids(const DetectionLog& log, const Points& known_m);

}  // namespace mapproof
