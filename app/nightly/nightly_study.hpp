#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "app/study/study_request.hpp"
#include "app/study/study_run.hpp"
#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// Reads what is asked for, all of it before anything is made.
/// @param experiments  Names of embedded ones, or files.
/// @param options      Its profile is taken of the experiments that have it.
/// @throws IoError, InvalidInput: among others if two have one name.
std::vector<StudyRequest> read_nightly_requests(const std::vector<std::string>& experiments,
                                                StudyOptions options);

/// What the studies of a nightly run will be, before they are made: names and what they are
/// compared by.
std::vector<NightlyStudy> planned_studies(const std::vector<StudyRequest>& requests);

/// Makes the records of a study in a process of its own, so that the peak of its memory is its own
/// and its crash is its own.
/// @return The ExitCode of that process, kInternal if a signal ended it. @throws IoError.
int make_apart(const StudyRequest& request, const std::filesystem::path& folder, int jobs,
               const SessionNames& names, const Console& console);

}  // namespace mapproof
