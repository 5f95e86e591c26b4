#pragma once

#include <filesystem>
#include <string>

#include "app/console.hpp"
#include "app/study/study_request.hpp"

namespace mapproof {

/// What a session is known by in the records.
struct SessionNames {
  std::string command;  ///< What makes the study again.
  std::string host;
};

/// Runs what a folder does not hold yet, with a progress line, and notes the session.
/// @throws IoError, InvalidInput.
void make_study(const StudyRequest& request, const std::filesystem::path& folder, int jobs,
                const SessionNames& names, const Console& console);

}  // namespace mapproof
