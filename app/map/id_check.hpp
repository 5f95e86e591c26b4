#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/association/anchor_ids.hpp"
#include "core/association/association_check.hpp"
#include "core/association/moved.hpp"
#include "core/model/detection_log.hpp"

namespace mapproof {

/// What to check and to correct in the landmark IDs.
struct AssociationChoice {
  bool check = false;       ///< Report IDs that contradict the others, or known positions.
  bool repair = false;      ///< And correct them before mapping.
  bool find_moved = false;  ///< Report landmarks that moved, and map both positions.

  bool asked() const { return check || repair || find_moved; }
};

/// One finding about landmark IDs.
struct AssociationFact {
  /// "swapped", "wrong", "mixed", "shared" (by two landmarks), "exchanged" (in all detections),
  /// "moved".
  std::string what;
  std::string first;      ///< The landmark ID,
  std::string second;     ///< and the other one; empty if it moved, or is not known.
  std::string sentence;   ///< The same in words, with when and how many.
  double before_m = 0.0;  ///< The map's loss, or of "exchanged" its misfit to the known positions,
  double after_m = 0.0;   ///< and what is left of it without the fault.
  bool repaired = false;
};

/// The log as it is to be mapped, and what was found.
struct AssociationOutcome {
  DetectionLog log;
  std::vector<AssociationFact> facts = {};
  std::vector<std::string> remarks = {};   ///< A sentence each.
  std::vector<std::string> warnings = {};  ///< Likewise: reasons to doubt the map.
  double loss_m = 0.0;  ///< Of the pairs, what was found corrected; 0: not checked.
  std::vector<std::string> doubtful = {};      ///< Landmarks that fit worst then.
  std::optional<AssociationCheck> check = {};  ///< Of the log as it is mapped, if it was made.
};

/// Checks, and if that is chosen corrects, the landmark IDs of detections with range and bearing.
/// @param known_m  M x 2; NaN rows: unknown positions.
AssociationOutcome with_association_checked(const DetectionLog& log,
                                            const AssociationChoice& choice, const Points& known_m);

/// The findings, for the member "data_association" of --json.
nlohmann::ordered_json association_json(const std::vector<AssociationFact>& facts);

}  // namespace mapproof
