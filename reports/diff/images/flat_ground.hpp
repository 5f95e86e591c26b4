#pragma once

#include <vector>

#include "render/image/image.hpp"
#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/image_changes.hpp"

namespace mapproof {

/// Marks as changed what one image shows where the other one is flat all around, whatever else
/// differs: no rendering draws anything there.
///
/// It marks groups of connected pixels, corners too: of at least 4 pixels that differ by 21 of 255
/// or more in a channel, or of at least 20 that differ by 10 or more. Flat means that no channel
/// varies by more than 6 within 2 pixels, and further by as much as the options allow a part of the
/// image to move beyond the default. A drawing of 24 or 12 of 255 is therefore found on a ground
/// with noise, too. A larger tolerance marks no pixel that a smaller one does not.
/// @param tiles  Indices of the tiles that differ, which `marks` keeps.
/// @return Whether it marked any.
/// @pre The sizes of the images are equal.
/// @note Linear time in the pixels that differ. Parallel over tiles.
bool mark_drawing_on_flat_ground(const Image& baseline, const Image& current,
                                 const std::vector<int>& tiles, const ImageOptions& options,
                                 ChangeMap& marks);

/// Which tiles differ as rounding of colours does in a heat map of solid cells: by at most one
/// entry of a colour table (4 of 255), in another way in each cell, and evenly on the whole. None
/// where fewer than 16 colours differ so, or where the difference varies within cells, as under
/// something drawn over them, or hardly from cell to cell, as under a transparent layer.
/// @param tiles  Indices of the tiles that differ.
/// @return One value per element of `tiles`.
/// @pre The sizes of the images are equal.
std::vector<bool> rounded_tiles(const Image& baseline, const Image& current,
                                const std::vector<int>& tiles, int across);

}  // namespace mapproof
