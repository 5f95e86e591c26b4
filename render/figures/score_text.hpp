#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/model/score.hpp"

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

/// A title that states how far a map is off: "SMACOF · bearing · 200 steps: 0.14 m off in the mean";
/// `subject` alone if no position error is known.
std::string title_with_error(const std::string& subject, const std::optional<Score>& score);

}  // namespace mapproof
