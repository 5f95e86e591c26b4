#include "core/range_slam/refinement/key_poses.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

Eigen::Vector3d pose_of(const Trajectory& path, Eigen::Index row) {
  return {path.positions_m(row, 0), path.positions_m(row, 1), path.heading_rad(row)};
}

/// `pose` in the frame of `origin`.
Eigen::Vector3d seen_from(const Eigen::Vector3d& origin, const Eigen::Vector3d& pose) {
  Eigen::Vector3d seen;
  seen.head<2>() = Eigen::Rotation2Dd(-origin(2)) * Eigen::Vector2d((pose - origin).head<2>());
  seen(2) = pose(2) - origin(2);
  return seen;
}

/// The pose that `seen` from `origin` is.
Eigen::Vector3d reached_from(const Eigen::Vector3d& origin, const Eigen::Vector3d& seen) {
  Eigen::Vector3d pose = origin + seen;
  pose.head<2>() =
      origin.head<2>() + Eigen::Rotation2Dd(origin(2)) * Eigen::Vector2d(seen.head<2>());
  return pose;
}

}  // namespace

std::string OdometryNoise::problem() const {
  const bool is_positive = forward_m > 0.0 && sideways_m > 0.0 && heading_change_rad > 0.0;
  return is_positive ? "" : "the noise of odometry must be positive";
}

Eigen::Vector3d BetweenPoses::pose(const Eigen::Vector3d& first,
                                   const Eigen::Vector3d& second) const {
  return (1.0 - share) * reached_from(first, ahead) + share * reached_from(second, behind);
}

KeyPoses::KeyPoses(const Trajectory& path, const OdometryNoise& noise, double spacing_m,
                   const std::vector<double>& breaks_s)
    : path_(path) {
  if (path.size() < 2 || path.heading_rad.size() != path.size())
    throw InvalidInput("key poses need a path of 2 poses or more, with headings");
  if (const std::string problem = noise.problem(); !problem.empty()) throw InvalidInput(problem);
  if (!(spacing_m >= 0.0)) throw InvalidInput("the spacing of poses cannot be negative");
  rows_.push_back(0);
  double way_m = 0.0;
  const auto holds_break = [&](Eigen::Index row) {
    const auto next = std::ranges::upper_bound(breaks_s, path.time_s(row - 1));
    return next != breaks_s.end() && *next <= path.time_s(row);
  };
  for (Eigen::Index row = 1; row < path.size(); ++row) {
    way_m += (path.positions_m.row(row) - path.positions_m.row(row - 1)).norm();
    const bool is_key = way_m >= spacing_m || row + 1 == path.size() || holds_break(row) ||
                        holds_break(row + 1 < path.size() ? row + 1 : row);
    if (!is_key) continue;
    motions_.push_back(motion_between(rows_.back(), row, noise));
    rows_.push_back(row);
    way_m = 0.0;
  }
  rotations_.reserve(rows_.size());
  for (const Eigen::Index row : rows_)
    rotations_.push_back(Eigen::Rotation2Dd(-path_.heading_rad(row)).toRotationMatrix());
}

KeyMotion KeyPoses::motion_between(Eigen::Index first, Eigen::Index last,
                                   const OdometryNoise& noise) const {
  const Eigen::Vector3d origin = pose_of(path_, first);
  const Eigen::Vector3d variances(noise.forward_m * noise.forward_m,
                                  noise.sideways_m * noise.sideways_m,
                                  noise.heading_change_rad * noise.heading_change_rad);
  // The error of what was put together so far turns with its heading's error at each step.
  Eigen::Matrix3d P = Eigen::Matrix3d::Zero();
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (Eigen::Index row = first + 1; row <= last; ++row) {
    const Eigen::Vector3d after = seen_from(origin, pose_of(path_, row));
    Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
    F(0, 2) = -(after(1) - before(1));
    F(1, 2) = after(0) - before(0);
    Eigen::Matrix3d G = Eigen::Matrix3d::Identity();
    G.topLeftCorner<2, 2>() = Eigen::Rotation2Dd(before(2)).toRotationMatrix();
    P = (F * P * F.transpose() + G * variances.asDiagonal() * G.transpose()).eval();
    before = after;
  }
  KeyMotion motion{.step = before};
  const Eigen::LLT<Eigen::Matrix3d> factor(P);
  motion.root_information = factor.matrixL().solve(Eigen::Matrix3d::Identity());
  return motion;
}

Eigen::Vector3d KeyPoses::seen_from_key(Eigen::Index key, const Eigen::Vector3d& pose) const {
  const auto k = static_cast<std::size_t>(key);
  Eigen::Vector3d seen = pose - pose_of(path_, rows_[k]);
  seen.head<2>() = (rotations_[k] * seen.head<2>()).eval();
  return seen;
}

BetweenPoses KeyPoses::at(double time_s) const {
  const Eigen::VectorXd& times = path_.time_s;
  const Eigen::Index last = times.size() - 1;
  const auto after = std::clamp<Eigen::Index>(
      std::upper_bound(times.begin(), times.end(), time_s) - times.begin(), 1, last);
  const double part =
      std::clamp((time_s - times(after - 1)) / (times(after) - times(after - 1)), 0.0, 1.0);
  const Eigen::Vector3d pose =
      (1.0 - part) * pose_of(path_, after - 1) + part * pose_of(path_, after);

  const auto next = std::lower_bound(rows_.begin() + 1, rows_.end() - 1, after);
  const Eigen::Index first_row = *(next - 1);
  const Eigen::Index second_row = *next;
  return {.before = next - rows_.begin() - 1,
          .share = std::clamp((time_s - times(first_row)) / (times(second_row) - times(first_row)),
                              0.0, 1.0),
          .ahead = seen_from_key(next - rows_.begin() - 1, pose),
          .behind = seen_from_key(next - rows_.begin(), pose)};
}

}  // namespace mapproof
