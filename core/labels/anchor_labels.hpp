#pragma once

#include <vector>

#include "core/model/detection_log.hpp"
#include "core/model/points.hpp"

namespace mapproof {

/// The fewest known places that tell of exchanged labels: a similarity meets any two.
inline constexpr int kFewestKnownPlaces = 4;

/// Two labels that stand for each other in all detections.
struct AnchorExchange {
  int first = 0;                 ///< A landmark whose place is known,
  int second = 0;                ///< and another one, known or not.
  double misfit_before_m = 0.0;  ///< Of all known places, as in AnchorCheck,
  double misfit_after_m = 0.0;   ///< and with this exchange undone.
};

/// What the known places of some landmarks say of the labels.
struct AnchorCheck {
  int places = 0;                         ///< Known, of landmarks on the map.
  std::vector<AnchorExchange> exchanges;  ///< In the order found, the plainest first.
  double misfit_before_m = 0.0;  ///< Root mean square distance of the map from the known places,
  double misfit_after_m = 0.0;   ///< turned, shifted and scaled so that far ones count little.
  DetectionLog repaired;         ///< The log with the exchanges undone.
};

/// Looks for labels that are exchanged throughout: pairs cannot show it, known places can.
///
/// An exchange is named only if it explains the known places by 30 variances better than the labels
/// do as given, and by 10 better than any other exchange in its place would; at most one for
/// kFewestKnownPlaces, and one more for each two places beyond. Exchanges over a part of the log
/// are check_labels' affair: correct them first.
/// @param known_m  M x 2; NaN rows: not known.
/// @throws InvalidInput if known_m has not a row for each landmark, or as scan_pairs does.
/// @note O(k M) fits of k places, of those 40 known ones that fit worst.
AnchorCheck check_anchor_labels(const DetectionLog& log, const Points& known_m);

}  // namespace mapproof
