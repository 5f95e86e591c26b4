#pragma once

#include <array>
#include <cstdint>

#include "reports/diff/images/change_map.hpp"

namespace mapproof {

inline constexpr int kPatchMargin = 6;  ///< Pixels around a tile.
inline constexpr int kPatchSide = kTile + 2 * kPatchMargin;
inline constexpr int kPatchCells = kPatchSide * kPatchSide;

/// A value a pixel, row by row.
using Plane = std::array<std::int16_t, kPatchCells>;

/// The place in a Plane of the pixel (x, y) of the tile.
constexpr int cell_at(int x, int y) { return (y + kPatchMargin) * kPatchSide + x + kPatchMargin; }

/// A tile and what is around it, channel by channel, red first. Outside the picture its edge goes
/// on. Of smoothed planes the outermost cells, as many as neighbours were taken of, have no
/// meaning.
struct Patch {
  std::array<Plane, 3> raw;       ///< 0 to 255.
  std::array<Plane, 3> smooth;    ///< 16 times the binomial mean of 3 x 3.
  std::array<Plane, 3> low;       ///< The least of `smooth` in 3 x 3.
  std::array<Plane, 3> high;      ///< The most.
  std::array<Plane, 3> smoother;  ///< 64 times the binomial mean of 5 x 5.
};

inline constexpr int kSmoothScale = 16;
inline constexpr int kSmootherScale = 64;

/// @param x0  Of the tile's upper left corner, as y0.
void load_patch(const Image& image, int x0, int y0, Patch& patch);

/// The least and the most of each cell and its eight neighbours.
void neighbour_bounds(const Plane& plane, Plane& low, Plane& high);

/// Both pictures around a tile.
struct PatchPair {
  Patch before, after;

  /// The largest difference of a channel.
  int difference(int cell) const;
  bool is_beyond(int cell, double noise) const { return difference(cell) > noise; }
};

}  // namespace mapproof
