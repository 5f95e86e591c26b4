#pragma once

#include <optional>
#include <vector>

#include "core/model/detection_log.hpp"

namespace mapproof {

/// A landmark ID that two landmarks share: its detections are at two positions.
struct SharedId {
  int id = 0;
  double apart_m = 0.0;      ///< Distance of the two positions,
  int first_detections = 0;  ///< the detections of the one that has more,
  int second_detections = 0;
  int undetermined = 0;  ///< and those that no scan assigns to either.
  /// Of each detection of the log: 1 or 2, the position that it shows; 0: of another ID, or
  /// undetermined.
  std::vector<char> position = {};
  double loss_before_m = 0.0;  ///< Root mean square of the pairs' residuals with outliers clipped,
  double loss_after_m = 0.0;   ///< with one position and with two.
};

/// The ID whose detections are most clearly at two positions, if splitting it explains the scans
/// significantly better: one landmark had another's ID in all its detections.
///
/// Each ID in turn is left out of the map; a scan with two other landmarks or more then determines
/// where the ID's detection stands.
/// @note A pair_map_of() for each ID.
std::optional<SharedId> shared_id(const DetectionLog& log);

/// The log with the second position under an ID of its own; undetermined detections are left out.
/// @param second  Row of its name: one that has no detections, or the next after the last.
DetectionLog split_id(const DetectionLog& log, const SharedId& shared, int second);

}  // namespace mapproof
