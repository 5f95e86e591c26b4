#include "core/range_slam/odometry_fit.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

Eigen::VectorXcd centered_as_complex(const Points& points) {
  Eigen::VectorXcd z(points.rows());
  z.real() = points.col(0);
  z.imag() = points.col(1);
  return z.array() - z.mean();
}

/// Scale of one piece, and its say in the median.
struct Piece {
  double scale;
  double weight;
};

double weighted_median(std::vector<Piece>& pieces, double total) {
  std::ranges::sort(pieces, {}, &Piece::scale);
  double below = 0.0;
  for (const Piece& piece : pieces)
    if ((below += piece.weight) >= 0.5 * total) return piece.scale;
  return 1.0;
}

}  // namespace

OdometryFit fit_to_odometry(const Points& positions_m, const Points& odometry_m,
                            Eigen::Index piece) {
  const Eigen::Index T = positions_m.rows();
  if (odometry_m.rows() != T || piece < 2)
    throw InvalidInput("odometry is compared pose by pose, in pieces of two or more");
  if (!positions_m.allFinite() || !odometry_m.allFinite())
    throw InvalidInput("paths must be finite to be compared");

  // As complex numbers a turn with a scale is a factor a: |a| is the regression of the map on
  // odometry, which is the cleaner of the two over a short piece.
  std::vector<Piece> straight, mirrored;
  double upright = 0.0, turned = 0.0, total = 0.0;
  for (Eigen::Index first = 0; first < T; first += std::max<Eigen::Index>(piece / 2, 1)) {
    const Eigen::Index count = std::min(piece, T - first);
    if (count < 2) break;
    const Eigen::VectorXcd map = centered_as_complex(positions_m.middleRows(first, count));
    const Eigen::VectorXcd odometry = centered_as_complex(odometry_m.middleRows(first, count));
    const double moved = odometry.squaredNorm();
    if (!(moved > 0.0)) continue;
    const double as_is = std::abs(odometry.dot(map));
    const double as_mirror = std::abs((odometry.array() * map.array()).sum());
    straight.push_back({as_is / moved, moved});
    mirrored.push_back({as_mirror / moved, moved});
    upright += as_is * as_is / moved;
    turned += as_mirror * as_mirror / moved;
    total += moved;
  }
  OdometryFit fit;
  if (!(total > 0.0) || !(upright + turned > 0.0)) return fit;
  fit.mirrored = turned > upright;
  const double scale = weighted_median(fit.mirrored ? mirrored : straight, total);
  if (scale > 0.0) fit.scale = scale;
  fit.agreement = std::abs(upright - turned) / std::max(upright, turned);
  return fit;
}

}  // namespace mapproof
