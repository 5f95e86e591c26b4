#pragma once

#include "reports/diff/change_map.hpp"
#include "reports/diff/picture_diff.hpp"

namespace mapproof {

struct ImageDiff {
  PixelDiff pixels;
  ChangeMap marks;  ///< Empty if the sizes differ.
};

/// Compares two pictures.
/// @throws InvalidInput if the options cannot be used.
ImageDiff image_diff(const Image& baseline, const Image& current, const PictureOptions& options);

}  // namespace mapproof
