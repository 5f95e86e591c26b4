#pragma once

#include <array>
#include <cmath>

#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/picture_changes.hpp"
#include "reports/diff/images/tile_patch.hpp"

namespace mapproof {

/// To the pixels around one, right and down.
inline constexpr std::array<std::array<int, 2>, 8> kSteps{
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

/// What a tile's difference looks like.
struct TileEvidence {
  int differing = 0;     ///< Pixels that differ at all.
  int beyond_noise = 0;  ///< Of them, those with a channel beyond the noise.
  int bold = 0;          ///< Of those, pixels that change by more than an edge near them explains.
  int lost = 0;  ///< Of those, pixels of which no neighbour in the other picture has anything.
  /// Of 255: how far the mean of flat pixels moves, of the whole tile or three of its rows or
  /// columns, less what noise explains; at most 0 if noise explains all.
  double flat_shift = -1.0;
  double flat_shift_in_noise = -1.0;  ///< The same, if there were noise all over.
  /// Of those beyond noise, pixels with the colour that the one at each of kSteps from it had.
  std::array<int, 8> copied{};
  std::array<double, 3> sum{};           ///< Of the differences beyond noise, a channel.
  std::array<double, 3> absolute_sum{};  ///< Of their sizes.
  MovementFit fit;                       ///< Of the smoothed difference.
  double right_px = 0.0, down_px = 0.0;  ///< The movement that explains most of it.
  double moved_share = 0.0;              ///< Of the energy, what that movement explains.
  double left_share = 1.0;               ///< What a movement of at most 0.35 px leaves.
  /// The same of whole pixels and what they leave to explain; 1 if the movement is below half of
  /// one.
  double left_by_whole = 1.0;
  KeptShape kept;                 ///< Left as it is where few pixels are beyond noise.
  double recoloured_share = 0.0;  ///< Of the raw energy, what a change of inks alone explains.
  double recolouring = 0.0;       ///< Of 255: how far inks leave the line from the paper to them.
  int edge_pixels = 0;            ///< That recoloured_share is told by.
  double least_structure = 1.0;   ///< Of its 8 x 8 windows [wang2004], by luma.
  PixelBox least_structure_at;
  double largest_colour_difference = 0.0;  ///< 0 to 1 [kotsarenko2010].

  double displacement_px() const { return std::hypot(right_px, down_px); }
  /// Whether pixels beyond noise go one way in the channel that changes most: more ink or less.
  bool is_one_sided() const;
};

/// What evidence is weighed by.
struct EvidenceBounds {
  double noise = 2.0;             ///< Of 255: what one pixel may differ.
  double mean_noise = 0.4;        ///< Of 255: what a mean may, however many pixels it is of.
  double displacement_px = 0.35;  ///< How far a piece may be moved.
  bool is_noisy = false;          ///< Whether noise is seen all over; otherwise none is assumed.
};

/// Compares a tile, and the 6 pixels around it, and marks its pixels as equal, noise or smoothed.
/// @param tile  Cut off at the image's edge.
/// @pre The sizes of the images are equal.
TileEvidence tile_evidence(const Image& baseline, const Image& current, const PixelBox& tile,
                           const EvidenceBounds& bounds, TileMarks& marks);

}  // namespace mapproof
