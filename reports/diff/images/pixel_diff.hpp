#pragma once

#include "render/image/image.hpp"
#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/image_changes.hpp"

namespace mapproof {

struct PixelComparison {
  PixelDiff pixels;
  ChangeMap marks;  ///< Empty if the sizes differ.
};

/// Compares two images, as docs/diff-images.md describes. A larger tolerance never finds a change
/// where a smaller one finds none.
/// @param current  Consumed; its ignored pixels are overwritten.
/// @throws InvalidInput if the options cannot be used.
/// @note Linear time; equal tiles cost a comparison of their bytes. Images that differ are judged
///       once for each step of tolerance up to the options'. Parallel over tiles.
PixelComparison pixel_diff(const Image& baseline, Image current, const ImageOptions& options = {});

}  // namespace mapproof
