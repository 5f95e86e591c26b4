#pragma once

#include <filesystem>
#include <vector>

#include "core/trials/topic.hpp"

namespace mapproof {

/// The MRCLAM sets in a folder, by id: its folders that hold a RobotN_Measurement.dat, or the
/// folder itself; each is read whole.
/// @throws IoError as read_mrclam_detections.
std::vector<TrialData> mrclam_sets(const std::filesystem::path& folder);

}  // namespace mapproof
