#pragma once

#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/picture_changes.hpp"

namespace mapproof {

struct ImageDiff {
  PixelDiff pixels;
  ChangeMap marks;  ///< Empty if the sizes differ.
};

/// Compares two images, as docs/diff-images.md describes.
/// @param current  Consumed; its ignored pixels are overwritten.
/// @throws InvalidInput if the options cannot be used.
/// @note Linear time; equal tiles cost a comparison of their bytes. Parallel over tiles.
ImageDiff image_diff(const Image& baseline, Image current, const PictureOptions& options = {});

}  // namespace mapproof
