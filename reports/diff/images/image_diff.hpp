#pragma once

#include <filesystem>

#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/image_changes.hpp"
#include "reports/diff/images/pixel_diff.hpp"

namespace mapproof {

/// Compares two image files of one format. Invalid content is not an error: the state is then
/// kUnreadable.
///
/// @param heat  If given, gets heat_map of two images that are not identical, else nothing.
/// @throws IoError if a file cannot be opened or exceeds 2^28 bytes.
/// @throws InvalidInput if the options cannot be used.
/// @note Files with equal bytes, and PNGs that differ only in their texts, are not decoded.
/// Otherwise memory holds two images of 4 bytes per pixel, or of a large image two strips
/// (StripDiff), one byte per pixel where they differ, and with `heat` one per pixel. Uses oneTBB's
/// threads; the result does not depend on them.
ImageDiff image_diff(const std::filesystem::path& baseline, const std::filesystem::path& current,
                     const ImageOptions& options = {}, HeatMap* heat = nullptr);

/// The baseline in pale grey, changed pixels in red, pixels explained by noise or anti-aliasing in
/// yellow; of a large image as StripDiff::heat(), of SVGs as they are drawn at twice their size.
/// Empty (0 x 0) if the files cannot be read, are identical or differ much in size.
/// @throws as image_diff.
HeatMap heat_map(const std::filesystem::path& baseline, const std::filesystem::path& current,
                 const ImageOptions& options = {});

}  // namespace mapproof
