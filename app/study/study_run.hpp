#pragma once

#include <filesystem>
#include <string>

#include "app/console.hpp"
#include "app/study/study_order.hpp"

namespace mapproof {

/// Runs what a folder does not hold yet, with a progress line, and notes the session.
/// @param command  What makes the study again. @throws IoError, InvalidInput.
void make_study(const StudyOrder& order, const std::filesystem::path& folder, int jobs,
                const std::string& command, const Console& console);

}  // namespace mapproof
