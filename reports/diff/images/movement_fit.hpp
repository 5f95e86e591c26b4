#pragma once

#include <array>
#include <cmath>

#include "reports/diff/images/tile_patch.hpp"

namespace mapproof {

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
