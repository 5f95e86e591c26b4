#pragma once

#include "reports/diff/images/tile_patch.hpp"

namespace mapproof {

/// How well a tile's difference is told by other inks on the same shapes.
struct Recolouring {
  double share = 0.0;  ///< Of the sum of squares of the difference, what an affine map explains.
  double off_line =
      0.0;         ///< Of 255: the most that a pixel leaves the line from the paper to its ink.
  int pixels = 0;  ///< That differ beyond the noise, and their neighbours.
};

/// Fits D = M (red, green, blue, 1) to the pixels that differ and those beside them: exact if up to
/// four inks, mixed by smoothing, have become others. Smoothing itself makes a pixel's ink more or
/// less, and so leaves it on the line from the paper to the ink.
Recolouring find_recolouring(const PatchPair& pair, double noise);

}  // namespace mapproof
