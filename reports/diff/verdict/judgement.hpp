#pragma once

#include <span>
#include <vector>

#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/shape_changes.hpp"
#include "reports/diff/images/tile_evidence.hpp"

namespace mapproof {

/// Groups of tiles that touch, corners too; each group in the order of its tiles' numbers.
/// @param is_in  One a tile, row by row.
std::vector<std::vector<int>> tile_groups(int across, std::vector<bool> is_in);

/// Decides which differences are changes, and marks their pixels so.
///
/// Another way of smoothing, other hints or a small shift of everything touch edges all over a
/// picture. A few groups of tiles in one that else is equal are therefore changes unless a small
/// movement explains them; of what differs all over, only that counts which smoothing cannot do:
/// things lost or new, movements beyond half a pixel, other inks, other means of flat regions,
/// and what shape_changes finds.
///
/// @param tiles     Numbers of the tiles that differ; `evidence` is theirs.
/// @param texture   Of the baseline.
void judge(std::span<const int> tiles, std::span<const TileEvidence> evidence,
           const Texture& texture, const PictureOptions& options, ChangeMap& marks);

}  // namespace mapproof
