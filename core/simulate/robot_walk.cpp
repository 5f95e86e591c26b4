#include "core/simulate/robot_walk.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/base/angle.hpp"
#include "core/base/errors.hpp"
#include "core/simulate/landmark_grid.hpp"

namespace mapproof {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kTurnResolution =
    kPi / 90.0;  // 2 degrees: finer turns change nothing in the maps.

/// The free positions of the robot's centre.
class FreeSpace {
 public:
  FreeSpace(const World& world, const WalkOptions& options)
      : world_(world),
        margin_(options.wall_margin_m),
        least_(options.clearance_m + world.landmark_diameter_m / 2.0),
        grid_(world.landmarks_m, world.side_m, least_) {}

  bool contains(double x, double y) const {
    if (x < margin_ || y < margin_ || x > world_.side_m - margin_ || y > world_.side_m - margin_)
      return false;
    return !grid_.any_near(x, y, least_, [&](Eigen::Index i) {
      const double dx = world_.landmarks_m(i, 0) - x;
      const double dy = world_.landmarks_m(i, 1) - y;
      return dx * dx + dy * dy < least_ * least_;
    });
  }

 private:
  const World& world_;
  double margin_;
  double least_;
  LandmarkGrid grid_;
};

struct Pose {
  double x;
  double y;
  double heading;
};

Pose ahead(const Pose& pose, double heading, double distance) {
  return {pose.x + distance * std::cos(heading), pose.y + distance * std::sin(heading), heading};
}

/// The next substep, after the smallest heading change that makes it free; empty if none does.
std::optional<Pose> next_substep(const FreeSpace& space, const Pose& pose, double length) {
  for (double turn = 0.0; turn <= kPi; turn += kTurnResolution)
    for (const double side : {1.0, -1.0}) {
      const Pose candidate = ahead(pose, pose.heading + side * turn, length);
      if (space.contains(candidate.x, candidate.y)) return candidate;
    }
  return std::nullopt;
}

Pose free_pose(const World& world, const FreeSpace& space, Random& random) {
  for (int attempt = 0; attempt < 10000; ++attempt) {
    const double x = random.uniform(0.0, world.side_m);
    const double y = random.uniform(0.0, world.side_m);
    const double heading = random.uniform(-kPi, kPi);
    if (space.contains(x, y)) return {x, y, heading};
  }
  throw InvalidInput("the room has no free position for the robot");
}

}  // namespace

Path random_walk(const World& world, const WalkOptions& options, int observations, Random& random) {
  if (observations < 1) throw InvalidInput("a walk needs at least one observation");
  const FreeSpace space(world, options);
  const int substeps =
      std::max(1, static_cast<int>(std::lround(options.step_m / options.substep_m)));
  const double length = options.step_m / substeps;

  Path path{.positions_m = Points(observations, 2), .headings_rad = Eigen::VectorXd(observations)};
  Pose pose = free_pose(world, space, random);
  for (Eigen::Index t = 0; t < observations; ++t) {
    path.positions_m.row(t) << pose.x, pose.y;
    path.headings_rad(t) = wrapped(pose.heading);
    pose.heading += random.uniform(-options.heading_change_rad, options.heading_change_rad);
    for (int i = 0; i < substeps; ++i) {
      const std::optional<Pose> next = next_substep(space, pose, length);
      if (!next) {
        pose.heading += kPi;
        break;
      }
      pose = *next;
    }
  }
  return path;
}

}  // namespace mapproof
