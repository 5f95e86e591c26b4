#include "core/pairs/handedness.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace mapproof {
namespace {

/// A triangle's area, twice; negative if clockwise.
double turn(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b, const Eigen::RowVector2d& c) {
  const Eigen::RowVector2d ab = b - a;
  const Eigen::RowVector2d ac = c - a;
  return ab.x() * ac.y() - ab.y() * ac.x();
}

/// Where the robot saw it, in its own frame.
Eigen::RowVector2d seen_at(const Sighting& seen) {
  return {seen.range_m * std::cos(seen.bearing_rad), seen.range_m * std::sin(seen.bearing_rad)};
}

/// Above 0 if the look and the map turn alike, each triple bounded by the smaller of its areas so
/// that no wrong one of it decides alone.
double agreement(std::span<const Sighting* const> look, const Points& map) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 2 < look.size(); ++k) {
    const double seen = turn(seen_at(*look[k]), seen_at(*look[k + 1]), seen_at(*look[k + 2]));
    const double mapped = turn(map.row(look[k]->landmark), map.row(look[k + 1]->landmark),
                               map.row(look[k + 2]->landmark));
    sum += std::copysign(std::min(std::abs(seen), std::abs(mapped)), seen * mapped);
  }
  return sum;
}

}  // namespace

bool seen_mirrored(const SightingLog& log, const Points& map) {
  double sum = 0.0;
  std::vector<const Sighting*> look;
  for (std::size_t k = 0; k < log.sightings.size(); ++k) {
    const Sighting& seen = log.sightings[k];
    if (!look.empty() && look.back()->step != seen.step) {
      sum += agreement(look, map);
      look.clear();
    }
    if (map.row(seen.landmark).allFinite() && std::isfinite(seen.range_m) &&
        std::isfinite(seen.bearing_rad))
      look.push_back(&seen);
  }
  return sum + agreement(look, map) < 0.0;
}

}  // namespace mapproof
