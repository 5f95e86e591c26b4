#include "core/range_slam/dead_reckoning.hpp"

#include <cmath>

#include "core/base/errors.hpp"

namespace mapproof {

Trajectory dead_reckoned(const RangeLog& log) {
  const auto poses = static_cast<Eigen::Index>(log.odometry.size()) + 1;
  if (poses < 2) throw InvalidInput("dead reckoning needs odometry");
  Trajectory path{.time_s = Eigen::VectorXd(poses),
                  .positions_m = Points(poses, 2),
                  .heading_rad = Eigen::VectorXd(poses)};
  path.time_s(0) = log.start.time_s;
  path.positions_m.row(0) << log.start.x_m, log.start.y_m;
  path.heading_rad(0) = log.start.heading_rad;
  for (Eigen::Index i = 1; i < poses; ++i) {
    const Motion& motion = log.odometry[static_cast<std::size_t>(i - 1)];
    if (!(motion.time_s > path.time_s(i - 1)))
      throw InvalidInput("the times of odometry must ascend from that of the start");
    const double cosine = std::cos(path.heading_rad(i - 1));
    const double sine = std::sin(path.heading_rad(i - 1));
    path.time_s(i) = motion.time_s;
    path.positions_m(i, 0) =
        path.positions_m(i - 1, 0) + motion.distance_m * cosine - motion.sideways_m * sine;
    path.positions_m(i, 1) =
        path.positions_m(i - 1, 1) + motion.distance_m * sine + motion.sideways_m * cosine;
    path.heading_rad(i) = path.heading_rad(i - 1) + motion.heading_change_rad;
  }
  if (!path.positions_m.allFinite() || !path.heading_rad.allFinite())
    throw InvalidInput("dead reckoning needs finite odometry");
  return path;
}

}  // namespace mapproof
