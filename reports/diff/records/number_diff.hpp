#pragma once

#include <filesystem>
#include <string>

#include "reports/diff/records/record_diff.hpp"

namespace mapproof {

/// Every value of two files of records, whatever they are of: JSON by its pointers, other text line
/// by line. A number has the tolerance of the quantity that its key names, else that of `other`;
/// within an array what is relative goes by the largest number. Coordinates of a map whose frame is
/// its shape alone are left to points_diff().
/// @throws IoError if either cannot be read.
OtherDiff number_diff(const std::string& name, const std::filesystem::path& baseline,
                      const std::filesystem::path& current, const Tolerances& tolerances);

}  // namespace mapproof
