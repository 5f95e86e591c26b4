#pragma once

#include <string>
#include <string_view>

#include "core/model/trial_study.hpp"

namespace mapproof {

/// The files of a study of trials (docs/file-formats.md). All parsers throw IoError with the place.

/// study.json (mapproof.trial_study): experiment, design and provenance; parts are not
/// in it.
std::string trial_study_json(const TrialStudy& study);
TrialStudy parse_trial_study(std::string_view text, const std::string& source);

/// parts/ID.json (mapproof.trial_part), without its seconds.
/// @param digest  Of the data set that it was made of; empty: simulated.
std::string trial_part_json(const TrialPart& part, const std::string& digest);

/// A part, and the digest of its data.
struct ReadTrialPart {
  TrialPart part;
  std::string digest;
};

/// @param design  Every trial's setup, series, level and number of values is checked against it;
///                null: a file alone, that nothing is known about.
ReadTrialPart parse_trial_part(std::string_view text, const std::string& source,
                               const TrialDesign* design);

}  // namespace mapproof
