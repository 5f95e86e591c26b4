#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "reports/diff/records/record_comparison.hpp"

namespace mapproof {

/// How far points moved between two sides. Shapes without a frame are first aligned to each other
/// by translation, rotation, scale and reflection.
/// @return Empty if every point is equal.
std::optional<PointsDiff> points_diff(const std::string& record, const AlignedPoints& baseline,
                                      const AlignedPoints& current, const Tolerances& tolerances);

/// Whether two sets of true positions are equal within tolerance.
bool same_positions(const AlignedPoints& baseline, const AlignedPoints& current,
                    const Tolerances& tolerances);

/// Compares every value of two files of records of any kind: JSON by its pointers, other text line
/// by line. A number has the tolerance of the quantity that its key names, else that of `other`.
/// Within an array a relative tolerance refers to the largest number. points_diff() compares the
/// coordinates of a map that is defined up to a similarity; they are skipped here.
/// @throws IoError if either cannot be read.
OtherDiff number_diff(const std::string& name, const std::filesystem::path& baseline,
                      const std::filesystem::path& current, const Tolerances& tolerances);

}  // namespace mapproof
