#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/map/reference.hpp"
#include "core/model/detection_log.hpp"
#include "core/records/observations/detections.hpp"
#include "core/records/observations/observations.hpp"

namespace mapproof {

/// What a person wants done about labels.
struct LabelChoice {
  bool check = false;       ///< Name labels that contradict the others, or known places.
  bool repair = false;      ///< And correct them before mapping.
  bool find_moved = false;  ///< Name landmarks that moved, and map both of their places.

  bool asked() const { return check || repair || find_moved; }
};

/// One thing that was found about labels.
struct LabelFact {
  /// "swapped", "wrong", "mixed", "shared" (by two landmarks), "exchanged" (in all detections),
  /// "moved".
  std::string what;
  std::string first;      ///< The label,
  std::string second;     ///< and the other one; empty if it moved, or is not known.
  std::string sentence;   ///< The same in words, with when and how many.
  double before_m = 0.0;  ///< The map's loss, or of "exchanged" its misfit to the known places,
  double after_m = 0.0;   ///< and what is left of it without the fault.
  bool repaired = false;
};

/// The log as it is to be mapped, and what was found.
struct LabelOutcome {
  DetectionLog log;
  std::vector<LabelFact> facts = {};
  std::vector<std::string> remarks = {};   ///< A sentence each.
  std::vector<std::string> warnings = {};  ///< The same, of what makes the map doubtful.
  double loss_m = 0.0;  ///< Of the pairs, what was found corrected; 0: not checked.
  std::vector<std::string> doubtful = {};  ///< Landmarks that fit worst then.
};

/// Checks, and if that is chosen corrects, the labels of detections with range and bearing.
/// @param known_m  M x 2; NaN rows: places that are not known.
LabelOutcome with_labels_checked(const DetectionLog& log, const LabelChoice& choice,
                                 const Points& known_m);

/// What was found in a source's labels, and what makes its map doubtful.
struct CheckedLabels {
  std::vector<LabelFact> facts = {};
  std::vector<std::string> warnings = {};
};

/// The same of a source, its truth, and the places that files name.
CheckedLabels check_labels_of(DetectionSource& source, const LabelChoice& choice,
                              const std::optional<NamedPointsFile>& anchors,
                              const std::optional<NamedPointsFile>& truth);

/// The same of a source that was read from a folder of MRCLAM: its history is made anew from what
/// came of the detections.
/// @throws IoError for any other source: one kind of value alone tells nothing of labels.
CheckedLabels check_labels_of(ObservationSource& source, const LabelChoice& choice,
                              const std::optional<NamedPointsFile>& anchors,
                              const std::optional<NamedPointsFile>& truth);

}  // namespace mapproof
