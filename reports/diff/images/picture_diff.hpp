#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/image/image.hpp"
#include "reports/diff/images/picture_changes.hpp"

namespace mapproof {

/// Compares two PNG or two SVG files. What is wrong with their content is data: kUnreadable.
///
/// @param heat  If given, gets heat_map of two PNGs of one size that are not identical, else
/// nothing.
/// @throws IoError if a file cannot be opened or exceeds 2^28 bytes.
/// @throws InvalidInput if the options cannot be used.
/// @note Files of the same bytes, and PNGs that differ in their texts alone, are not decoded. Else
///       two pictures of 4 bytes a pixel are held, and a byte a pixel where they differ. Uses
///       oneTBB's threads; the result does not depend on them.
PictureDiff picture_diff(const std::filesystem::path& baseline,
                         const std::filesystem::path& current, const PictureOptions& options = {},
                         Image* heat = nullptr);

/// The baseline in pale grey, changed pixels red, those yellow that noise or smoothing explains.
/// Empty (0 x 0) if the files are no PNGs, cannot be read, are identical or their sizes differ.
/// @throws as picture_diff.
Image heat_map(const std::filesystem::path& baseline, const std::filesystem::path& current,
               const PictureOptions& options = {});

}  // namespace mapproof
