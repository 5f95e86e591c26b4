#include "tests/core/range_slam/plaza.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>

#include "core/records/range_log_files.hpp"
#include "core/score/trajectory_error.hpp"

namespace mapproof::test {
namespace {

Trajectory integrated(const StartPose& start, const std::vector<Motion>& motions) {
  Trajectory path;
  const Eigen::Index T = std::ssize(motions) + 1;
  path.time_s.resize(T);
  path.positions_m.resize(T, 2);
  path.heading_rad.resize(T);
  path.time_s(0) = start.time_s;
  path.positions_m.row(0) << start.x_m, start.y_m;
  path.heading_rad(0) = start.heading_rad;
  for (Eigen::Index t = 1; t < T; ++t) {
    const Motion& motion = motions[static_cast<std::size_t>(t - 1)];
    const double heading = path.heading_rad(t - 1);
    path.time_s(t) = motion.time_s;
    path.positions_m.row(t) =
        path.positions_m.row(t - 1) +
        motion.distance_m * Eigen::RowVector2d(std::cos(heading), std::sin(heading));
    path.heading_rad(t) = heading + motion.turn_rad;
  }
  return path;
}

}  // namespace

std::optional<Plaza> plaza(const std::string& name) {
  const char* folder = std::getenv("MAPPROOF_PLAZA");
  if (folder == nullptr || *folder == '\0') return std::nullopt;
  Plaza plaza;
  plaza.log = read_range_log(std::filesystem::path(folder) / name);
  plaza.odometry = integrated(plaza.log.start, plaza.log.odometry);
  return plaza;
}

double mean_error_m(const Plaza& plaza, const SlamEstimate& estimate, Alignment alignment) {
  const auto error =
      trajectory_error(estimate, *plaza.log.truth, plaza.log.true_landmarks, alignment);
  return error ? error->mean_m : std::numeric_limits<double>::infinity();
}

}  // namespace mapproof::test
