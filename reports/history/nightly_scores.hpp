#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/results/results.hpp"
#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// The results that nightly runs keep, and the seconds of the parts, by what they are of.
Scores scores_of(const Results& results, const std::vector<Result>& seconds);

/// What nightly runs are compared by: the SHA-256 of a study.json without what made it, which
/// leaves the experiment as it was ordered. @throws IoError if the text is not JSON of a form.
std::string experiment_digest(const std::string& study_json, const std::string& source);

/// The study in a folder as a nightly run keeps it, its figures apart. @throws IoError.
NightlyStudy read_nightly_study(const std::filesystem::path& folder, const std::string& name);

}  // namespace mapproof
