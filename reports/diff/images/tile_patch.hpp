#pragma once

#include <array>
#include <cmath>
#include <cstdint>

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

/// Normal equations of the movement that explains a difference best by least squares [lucas1981].
struct MovementFit {
  double energy = 0.0;  ///< Sum of squares of the difference.
  double gxx = 0.0, gxy = 0.0, gyy = 0.0, gxd = 0.0, gyd = 0.0;

  void add(const MovementFit& other, double weight);
  /// The movement, right and down. Along a straight edge it is not determined, and taken as zero.
  std::array<double, 2> movement() const;
  /// The energy that remains after a movement.
  double left(double right_px, double down_px) const;
};

/// Fits the difference of the `smoother` planes.
/// @param noise   Of 255: values that differ by no more count as equal.
/// @param offset  In cells: the movement of the baseline before the fit.
/// @param around  Pixels around the tile that take part.
MovementFit movement_fit(const PatchPair& pair, double noise, int offset, int around);

/// A movement under which the shapes in a tile persist, found from slightly smoothed pixels. The
/// shapes of a letter with different hinting do not persist.
struct KeptShape {
  double left = 1.0;  ///< The share of the energy that remains after the movement; 0 to 1.
  double right_px = 0.0, down_px = 0.0;

  double displacement_px() const { return std::hypot(right_px, down_px); }
};

/// @param right_px, down_px  The first guess. Movements up to 3.75 px are found.
KeptShape kept_shape(const PatchPair& pair, double right_px, double down_px);

}  // namespace mapproof
