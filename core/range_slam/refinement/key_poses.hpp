#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/range_log.hpp"

namespace mapproof {

/// Standard deviations of one motion.
struct OdometryNoise {
  double forward_m = 0.02;
  double sideways_m = 0.02;
  double heading_change_rad = 0.005;

  /// The problem if one is not positive; empty otherwise.
  std::string problem() const;
};

/// The way from one key pose to the next, in the frame of the first: forward, left, heading change.
struct KeyMotion {
  Eigen::Vector3d step = Eigen::Vector3d::Zero();
  Eigen::Matrix3d root_information = Eigen::Matrix3d::Identity();  ///< W, W'W the information.
};

/// A pose on the path as the two key poses around it give it: (1 - share) of the one reckoned
/// ahead from the pose before, share of the one reckoned back from the pose after.
struct BetweenPoses {
  Eigen::Index before = 0;  ///< Key pose; the other is the next one.
  double share = 0.0;
  Eigen::Vector3d ahead =
      Eigen::Vector3d::Zero();  ///< Forward, left, heading change from the pose before.
  Eigen::Vector3d behind = Eigen::Vector3d::Zero();  ///< The same from the pose after.

  /// x, y and heading. @param first, second  The two key poses, their headings not wrapped.
  Eigen::Vector3d pose(const Eigen::Vector3d& first, const Eigen::Vector3d& second) const;
};

/// The poses of a dead-reckoned path that are estimated: all, or about one for each `spacing_m` of
/// way. Motions between them are put together with their covariance; other poses follow from them.
class KeyPoses {
 public:
  /// @param path  From dead_reckoned(), T >= 2.
  /// @param breaks_s  Ascending; the poses before and after each of them are key poses, too.
  /// @throws InvalidInput unless the noise is positive and the spacing is not negative.
  KeyPoses(const Trajectory& path, const OdometryNoise& noise, double spacing_m,
           const std::vector<double>& breaks_s = {});

  Eigen::Index size() const { return static_cast<Eigen::Index>(rows_.size()); }
  /// Rows in the path, the first and the last one among them.
  const std::vector<Eigen::Index>& rows() const { return rows_; }
  /// size() - 1 of them.
  const std::vector<KeyMotion>& motions() const { return motions_; }
  /// @param time_s  Within the time of the path. @note O(log T).
  BetweenPoses at(double time_s) const;
  const Trajectory& path() const { return path_; }

 private:
  KeyMotion motion_between(Eigen::Index first, Eigen::Index last, const OdometryNoise& noise) const;
  /// A pose of the path in the frame of a key pose.
  Eigen::Vector3d seen_from_key(Eigen::Index key, const Eigen::Vector3d& pose) const;

  Trajectory path_;
  std::vector<Eigen::Index> rows_;
  std::vector<Eigen::Matrix2d> rotations_;  ///< Into the frames of the key poses.
  std::vector<KeyMotion> motions_;
};

}  // namespace mapproof
