#pragma once

#include <optional>
#include <vector>

#include "core/model/sighting_log.hpp"

namespace mapproof {

/// A label that two landmarks bear: its sightings are of two places.
struct SharedLabel {
  int label = 0;
  double apart_m = 0.0;     ///< The two places,
  int first_sightings = 0;  ///< the sightings of the one that has more,
  int second_sightings = 0;
  int untold = 0;  ///< and those of which no look tells whose they are.
  /// Of each sighting of the log: 1 or 2, the place that it shows; 0: of another label, or untold.
  std::vector<char> place = {};
  double loss_before_m = 0.0;  ///< Root mean square of the pairs' residuals, far ones drawn in,
  double loss_after_m = 0.0;   ///< with one place and with two.
};

/// The label whose sightings stand most plainly at two places, if splitting it explains the looks
/// clearly better: one landmark was called by another's name in all its sightings.
///
/// Each label in turn is left out of the map; where a look shows two other landmarks or more, it
/// then tells where the label's sighting stands.
/// @note Of each label a sighted_map().
std::optional<SharedLabel> shared_label(const SightingLog& log);

/// The log with the second place under a label of its own; untold sightings are left out.
/// @param second  Row of its name: one that has no sightings, or the next after the last.
SightingLog split_label(const SightingLog& log, const SharedLabel& shared, int second);

}  // namespace mapproof
