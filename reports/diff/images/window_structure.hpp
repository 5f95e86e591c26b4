#pragma once

#include "reports/diff/images/tile_patch.hpp"

namespace mapproof {

/// A window of a tile and its structural similarity.
struct WindowStructure {
  double structure = 1.0;
  int x = 0, y = 0, width = 0, height = 0;  ///< In the tile.
};

/// The window of 8 x 8 pixels, every 4 of them, whose structural similarity [wang2004] is least, by
/// luma. One number for a whole picture would hide a small damage.
/// @param width  Of the part of the tile that lies in the picture, as height.
WindowStructure least_window_structure(const PatchPair& pair, int width, int height);

}  // namespace mapproof
