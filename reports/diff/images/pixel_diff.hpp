#pragma once

#include "render/image/image.hpp"
#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/image_changes.hpp"

namespace mapproof {

struct PixelComparison {
  PixelDiff pixels;
  ChangeMap marks;  ///< Of the part that both have; empty if the sizes differ by more.
};

/// Compares two images, as docs/diff-images.md describes. A larger tolerance never finds a change
/// where a smaller one finds none.
/// @param current  Consumed; its ignored pixels are overwritten.
/// @throws InvalidInput if the options cannot be used.
/// @note Linear time; equal tiles cost a comparison of their bytes. Images that differ are judged
///       once for each step of tolerance up to the options'. Parallel over tiles.
PixelComparison pixel_diff(const Image& baseline, Image current, const ImageOptions& options = {});

/// Whether two sizes differ by so few pixels that the part which both images have is compared.
bool have_common_part(const ImageSize& a, const ImageSize& b);

/// The upper left part of an image. @param size  At most that of the image.
Image upper_left(const Image& image, const ImageSize& size);

}  // namespace mapproof
