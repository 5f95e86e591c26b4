#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/map_record.hpp"

namespace mapproof {

/// One error of a map, in the words that figures and reports share.
struct ErrorWords {
  std::string name;     ///< "MPE".
  std::string value;    ///< "0.219 m".
  std::string meaning;  ///< "mean position error".
  std::string limit;    ///< What it is free of, to follow the value; empty for the usual errors.
};

/// The errors that are known: MPE and MOE as the paper defines them; where the MPE is not finite
/// (no anchors, or no other landmarks) those that need no anchors. None is NaN.
std::vector<ErrorWords> error_words(const Score& score);

/// The same in one line: "MPE 0.219 m, MOE 4.70 %" or "MPE 0.310 m after the best affine fit to
/// all landmarks, MOE 4.20 % up to a mirror"; empty if no error is known.
std::string score_text(const Score& score);

/// A title that states how far a map is off: "SMACOF · bearing · 200 steps: 0.14 m off in the
/// mean"; `subject` alone if no position error is known.
std::string title_with_error(const std::string& subject, const std::optional<Score>& score);

/// The same of a map; without a score, how far the anchor that it misses most is off: "SMACOF ·
/// bearing · 200 steps: up to 0.35 m off at 4 anchors (L10)".
std::string title_with_error(const std::string& subject, const MapRecord& record);

/// The anchor that a map in metres misses most.
struct WorstAnchor {
  std::string name;
  double error_m = 0.0;        ///< Distance from where it was given.
  double share_percent = 0.0;  ///< Of the longer side of the map's box along its axes; NaN: no box.
  /// Whether the map contradicts its anchors, however well the data fit it: the error is above 10 %
  /// of that side. In a room of 2.5 m, where [yairi2007] has mean errors of 0.14 m (6 %) and more,
  /// the landmarks about such an anchor would be off by nearly twice the best published mean.
  bool is_contradicted = false;
};

/// None without anchors, for a map that was not aligned to them, and where the map meets three
/// anchors exactly: an affine map takes any three landmarks to any positions.
std::optional<WorstAnchor> worst_anchor(const MapRecord& record);

}  // namespace mapproof
