#pragma once

#include <filesystem>
#include <vector>

#include "core/trials/topic.hpp"

namespace mapproof {

/// The MRCLAM sets in a folder, by id: its folders that hold a RobotN_Measurement.dat, or the
/// folder itself. What is in them is not checked.
/// @throws IoError if a file of theirs cannot be read.
std::vector<TrialData> mrclam_sets(const std::filesystem::path& folder);

}  // namespace mapproof
