#pragma once

#include <array>
#include <cstdint>

#include "render/image/image.hpp"
#include "reports/diff/images/change_map.hpp"

namespace mapproof {

inline constexpr int kPatchMargin = 6;  ///< Pixels around a tile.
inline constexpr int kPatchSide = kTile + 2 * kPatchMargin;
inline constexpr int kPatchCells = kPatchSide * kPatchSide;

/// One value per pixel, row by row.
using Plane = std::array<std::int16_t, kPatchCells>;

/// The index in a Plane of the pixel (x, y) of the tile.
constexpr int cell_at(int x, int y) { return (y + kPatchMargin) * kPatchSide + x + kPatchMargin; }

/// A tile and its surroundings, channel by channel, red first. Outside the image the values of its
/// edge continue. The outermost cells of smoothed planes, to the radius of the smoothing, have no
/// meaning.
struct Patch {
  std::array<Plane, 3> raw;       ///< 0 to 255.
  std::array<Plane, 3> smooth;    ///< 16 times the binomial mean of 3 x 3.
  std::array<Plane, 3> low;       ///< The minimum of `smooth` in 3 x 3.
  std::array<Plane, 3> high;      ///< The maximum of `smooth` in 3 x 3.
  std::array<Plane, 3> smoother;  ///< 64 times the binomial mean of 5 x 5.
};

inline constexpr int kSmoothScale = 16;
inline constexpr int kSmootherScale = 64;

/// @param x0, y0  The tile's upper left corner.
void load_patch(const Image& image, int x0, int y0, Patch& patch);

/// The minimum and the maximum of each cell and its eight neighbours.
void neighbour_bounds(const Plane& plane, Plane& low, Plane& high);

/// Both images around a tile.
struct PatchPair {
  Patch before, after;

  /// The largest difference of a channel.
  int difference(int cell) const;
  bool is_beyond(int cell, double noise) const { return difference(cell) > noise; }
};

}  // namespace mapproof
