#pragma once

#include <array>
#include <cmath>
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

/// Normal equations of the movement that explains a difference best by least squares [lucas1981].
struct MovementFit {
  double energy = 0.0;  ///< Sum of squares of the difference.
  double gxx = 0.0, gxy = 0.0, gyy = 0.0, gxd = 0.0, gyd = 0.0;

  void add(const MovementFit& other, double weight);
  /// The movement, right and down. Along a straight edge nothing tells it: it is taken as none.
  std::array<double, 2> movement() const;
  /// The energy that a movement leaves.
  double left(double right_px, double down_px) const;
};

/// Of the difference of the `smoother` planes.
/// @param noise   Of 255: what differs by no more counts as equal.
/// @param offset  In cells: the baseline is taken as moved by so much.
/// @param around  Pixels around the tile that are looked at too.
MovementFit movement_fit(const PatchPair& pair, double noise, int offset, int around);

/// A movement under which a tile's things keep their shape, told by hardly smoothed pixels: those
/// of a letter that is hinted otherwise do not.
struct KeptShape {
  double left = 1.0;  ///< Of the energy, what the movement leaves; 0 to 1.
  double right_px = 0.0, down_px = 0.0;

  double displacement_px() const { return std::hypot(right_px, down_px); }
};

/// @param right_px  Where to look first, as down_px. Found is what lies up to 3.75 px away.
KeptShape kept_shape(const PatchPair& pair, double right_px, double down_px);

}  // namespace mapproof
