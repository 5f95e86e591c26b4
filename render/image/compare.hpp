#pragma once

#include "render/image/image.hpp"

namespace mapproof {

/// How two images differ.
struct ImageDifference {
  bool same_size = false;
  double changed_share = 1.0;  ///< Of pixels with a channel more than 16 of 255 apart.
  /// The least structural similarity [wang2004] of any 8 x 8 window in any channel, at most 1: one
  /// number for the whole would hide a small damage.
  double structure = 0.0;
  /// The most that the mean of any window moves in any channel, of 255: structure alone does not
  /// see that a dot has another colour.
  double shift = 255.0;
};

ImageDifference compare_images(const Image& a, const Image& b);

/// What still counts as the same image, perhaps drawn by another version of a library.
struct ImageTolerance {
  double most_changed = 0.002;
  double least_structure = 0.8;
  double most_shift = 4.0;
};

/// Whether sizes are equal and all bounds are kept.
bool is_alike(const ImageDifference& difference, const ImageTolerance& tolerance = {});

}  // namespace mapproof
