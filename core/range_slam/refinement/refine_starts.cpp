#include "core/range_slam/refinement/refine_starts.hpp"

#include <algorithm>

#include "core/base/random.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/trilateration.hpp"

namespace mapproof {

SlamEstimate dead_reckoning_start(const RangeLog& log) {
  SlamEstimate start;
  start.path = dead_reckoned(log);
  start.landmarks_m = trilaterated(log, start.path);
  return start;
}

SlamEstimate random_start(const RangeLog& log, std::uint64_t seed) {
  SlamEstimate start;
  start.path = dead_reckoned(log);
  double reach = 0.0;
  for (const RangeReading& reading : log.ranges) reach = std::max(reach, reading.range_m);
  const Eigen::RowVector2d low = start.path.positions_m.colwise().minCoeff().array() - reach;
  const Eigen::RowVector2d high = start.path.positions_m.colwise().maxCoeff().array() + reach;
  Random random(seed);
  start.landmarks_m.resize(static_cast<Eigen::Index>(log.landmarks.size()), 2);
  for (Eigen::Index n = 0; n < start.landmarks_m.rows(); ++n)
    for (const Eigen::Index axis : {0, 1})
      start.landmarks_m(n, axis) = random.uniform(low(axis), high(axis));
  return start;
}

}  // namespace mapproof
