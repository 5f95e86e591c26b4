#pragma once

#include <string>
#include <string_view>

#include "core/model/experiment.hpp"

namespace mapproof {

/// An experiment from the text of its file (docs/file-formats.md), every bound checked.
///
/// @param source   What to call the file in errors.
/// @param profile  The profile whose merge patch (RFC 7396) is applied first; "" for none.
/// @return Methods in the order of all_methods(), sensors in that of the enumeration.
/// @throws IoError with the place if the text is no such experiment or lacks that profile.
Experiment parse_experiment(std::string_view text, const std::string& source,
                            const std::string& profile = "");

/// The file that parses to exactly this experiment: canonical, every default written out.
std::string experiment_json(const Experiment& experiment);

}  // namespace mapproof
