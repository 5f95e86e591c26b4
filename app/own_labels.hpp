#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/sighting_log.hpp"
#include "core/records/observations.hpp"

namespace mapproof {

/// What a person wants done about labels.
struct LabelChoice {
  bool check = false;       ///< Name labels that contradict the others.
  bool repair = false;      ///< And mend them before mapping.
  bool find_moved = false;  ///< Name landmarks that moved, and map both of their places.

  bool asked() const { return check || repair || find_moved; }
};

/// The log as it is to be mapped, and what was found, a sentence each.
struct LabelOutcome {
  SightingLog log;
  std::vector<std::string> remarks;
};

/// Checks, and if that is chosen mends, the labels of sightings with range and bearing.
LabelOutcome with_labels_checked(const SightingLog& log, const LabelChoice& choice);

/// The same of a source that was read from a folder of MRCLAM: its history is made anew from what
/// came of the sightings.
/// @throws IoError for any other source: one kind of value alone tells nothing of labels.
void check_labels_of(ObservationSource& source, const LabelChoice& choice);

}  // namespace mapproof
