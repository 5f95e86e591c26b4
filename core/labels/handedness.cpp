#include "core/labels/handedness.hpp"

#include <cmath>

namespace mapproof {
namespace {

/// Twice the signed area of a triangle.
double area(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b, const Eigen::RowVector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

Eigen::RowVector2d seen_place(const Sighting& one) {
  return {one.range_m * std::cos(one.bearing_rad), one.range_m * std::sin(one.bearing_rad)};
}

}  // namespace

Points with_hand_of_looks(const SightingLog& log, Points map) {
  double agreement = 0.0;  // sum of areas' products: flat triangles say little
  const std::vector<Sighting>& rows = log.sightings;
  for (std::size_t k = 2; k < rows.size(); ++k) {
    if (rows[k - 2].step != rows[k].step) continue;
    const double seen = area(seen_place(rows[k - 2]), seen_place(rows[k - 1]), seen_place(rows[k]));
    const double mapped = area(map.row(rows[k - 2].landmark), map.row(rows[k - 1].landmark),
                               map.row(rows[k].landmark));
    if (const double both = seen * mapped; std::isfinite(both)) agreement += both;
  }
  if (agreement < 0.0) map.col(1) *= -1.0;
  return map;
}

}  // namespace mapproof
