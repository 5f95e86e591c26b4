#pragma once

#include <string>
#include <vector>

#include "core/association/anchor_ids.hpp"
#include "core/association/association_check.hpp"
#include "core/association/held_out.hpp"
#include "core/association/moved.hpp"
#include "core/association/shared_id.hpp"
#include "core/model/detection_log.hpp"

namespace mapproof {

// The sentences on data association. Names of landmarks are made printable.

/// A sentence: "IDs of 7 and 12 swapped from step 1200 on (310 detections): loss 0.410 -> 0.130 m".
std::string described(const AssociationFinding& finding, const DetectionLog& log);

/// A sentence: "7 moved by 0.21 m between step 1198 and step 1204 (p = 0.015)".
std::string described(const MovedLandmark& moved, const DetectionLog& log);

/// A sentence: "IDs of 3 and 10 swapped in all detections: known positions missed by 1.930 m, then
/// by 0.120 m".
std::string described(const AnchorExchange& exchange, const DetectionLog& log);

/// A sentence: "7 stands at two positions 2.10 m apart (80 and 31 detections): another landmark has
/// its landmark ID: loss 0.410 -> 0.130 m".
/// @param second  Whose ID it may be; empty: not known.
std::string described(const SharedId& shared, const std::string& first, const std::string& second);

/// What a correction leaves as it is, and what it leaves out.
/// @param repair  Whether it is made.
std::string undetermined_text(const AssociationFinding& finding, const DetectionLog& log,
                              bool repair);
std::string undetermined_text(const SharedId& shared, const std::string& first, bool repair);

/// That the scans do not fit one map, and with which landmarks they fit worst.
std::string doubts_text(const AssociationCheck& check, const DetectionLog& log);

/// That corrected IDs are used, or not, by how well their map predicts held-out scans.
std::string repair_kept_text(const HeldOutFit& held_out);
std::string repair_dropped_text(const HeldOutFit& held_out);

/// That a check ended without a result, and what the map is of then.
std::string check_failed_text(const std::string& what, const std::string& problem);

/// That a check without findings found none.
std::string nothing_found_text(const AssociationCheck& check);

/// That there are fewer than kFewestKnownPositions.
std::string too_few_known_text();

/// That no exchange of IDs would fit the known positions better.
std::string no_exchange_text(const AnchorCheck& check);

/// That the map misses known positions by more than it explains.
/// @param loss_m    Of the map. @param doubtful  Landmarks that fit worst.
std::string known_missed_text(const AnchorCheck& check, double loss_m,
                              const std::vector<std::string>& doubtful);

std::vector<std::string> shown_names(const std::vector<int>& landmarks, const DetectionLog& log);

}  // namespace mapproof
