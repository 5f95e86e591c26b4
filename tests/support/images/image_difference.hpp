#pragma once

#include "render/image/image.hpp"

namespace mapproof::test {

/// How two images differ.
struct ImageDifference {
  bool same_size = false;
  double changed_share = 1.0;  ///< Of pixels with a channel more than 16 of 255 apart.
  /// The least structural similarity [wang2004] of any 8 x 8 window in any channel, at most 1. One
  /// number for the whole image would hide small damage.
  double structure = 0.0;
  /// The largest change of the mean of any window in any channel, of 255. The structure alone does
  /// not show that a dot has another colour.
  double shift = 255.0;
};

/// How an image differs from its baseline: found apart from the program, whose `diff` is itself
/// tested on these images, and stricter than it, as it explains no difference by rendering noise or
/// anti-aliasing.
ImageDifference image_difference(const Image& a, const Image& b);

/// The bounds within which two images count as the same, perhaps drawn by two versions of a
/// library.
struct ImageTolerance {
  double most_changed = 0.002;
  double least_structure = 0.8;
  double most_shift = 4.0;
};

/// Whether the sizes are equal and the difference is within all bounds.
bool is_alike(const ImageDifference& difference, const ImageTolerance& tolerance = {});

}  // namespace mapproof::test
