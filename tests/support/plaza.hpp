#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "core/model/range_log.hpp"

namespace mapproof::test {

/// The folder of the Plaza data sets, which MAPPROOF_PLAZA names; empty where it names none.
std::optional<std::filesystem::path> plaza_folder();

/// What a test that is left out for want of it says.
inline constexpr const char* kNoPlaza = "MAPPROOF_PLAZA does not name the folder of the Plaza data";

/// One of the sets, with the ground truth.
/// @param name  "plaza1" or "plaza2".
/// @return Empty where there is no folder.
std::optional<RangeLog> plaza(const std::string& name);

}  // namespace mapproof::test
