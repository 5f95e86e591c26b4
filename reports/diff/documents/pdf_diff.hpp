#pragma once

#include <filesystem>

#include "reports/diff/images/picture_diff.hpp"

namespace mapproof {

/// Compares two PDFs by their bytes: what they show is told by the figure's value and by its other
/// pictures. Files that other versions of the library wrote are within tolerance, and it is said.
/// @throws IoError if either cannot be read.
PictureDiff pdf_diff(const std::filesystem::path& baseline, const std::filesystem::path& current);

}  // namespace mapproof
