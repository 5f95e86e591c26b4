#pragma once

#include <filesystem>

#include "reports/diff/quantities.hpp"
#include "reports/diff/record_diff.hpp"

namespace mapproof {

/// Compares all numbers of two JSON files one by one.
/// @throws IoError if one cannot be read.
OtherDiff number_diff(const std::string& name, const std::filesystem::path& baseline,
                      const std::filesystem::path& current, const Tolerance& tolerance);

}  // namespace mapproof
