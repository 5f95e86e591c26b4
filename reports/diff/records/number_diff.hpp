#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reports/diff/records/record_comparison.hpp"

namespace mapproof {

/// How far points moved between two sides. Shapes without a frame are aligned to each other first,
/// by place, turn, scale and mirror.
/// @return Nothing if every point is equal.
std::optional<PointsDiff> points_diff(const std::string& record, const PlacedPoints& baseline,
                                      const PlacedPoints& current, const Tolerances& tolerances);

/// Whether two sets of true places are the same within tolerance.
bool same_places(const PlacedPoints& baseline, const PlacedPoints& current,
                 const Tolerances& tolerances);

/// Every value of two files of records, whatever they are of: JSON by its pointers, other text line
/// by line. A number has the tolerance of the quantity that its key names, else that of `other`;
/// within an array what is relative goes by the largest number. Coordinates of a map whose frame is
/// its shape alone are left to points_diff().
/// @throws IoError if either cannot be read.
OtherDiff number_diff(const std::string& name, const std::filesystem::path& baseline,
                      const std::filesystem::path& current, const Tolerances& tolerances);

}  // namespace mapproof
