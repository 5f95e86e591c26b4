#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// Poses over time in space, T of them, in any frame.
struct SpacePath {
  Eigen::VectorXd time_s;   ///< T, not descending; the numbers of the poses from 0 without times.
  SpacePoints positions_m;  ///< T x 3, finite.
  /// T rotations from the frame of the pose to that of the path, or empty where no orientation is
  /// known.
  std::vector<Eigen::Matrix3d> orientations;
  bool has_times = true;  ///< Otherwise pose i belongs to pose i of any other path.

  Eigen::Index size() const { return time_s.size(); }
};

/// Some poses of a path that none of another path is associated with, as figures draw them.
struct LonePoses {
  Eigen::VectorXd time_s = {};                        ///< k, not descending.
  SpacePoints positions_m = SpacePoints::Zero(0, 3);  ///< k x 3.
};

/// The ground truth and an estimate at the same times, the estimate aligned.
struct PoseErrors {
  Eigen::VectorXd time_s;      ///< n, not descending; of the ground truth.
  Eigen::VectorXd distance_m;  ///< n: the way along the ground truth since its first pose here.
  SpacePoints estimate_m, ground_truth_m;  ///< n x 3.
  Eigen::VectorXd error_m;                 ///< n: the distance between the two positions.
  Eigen::VectorXd error_deg;  ///< n: the angle between the orientations; empty: not known.
  bool has_times = true;      ///< Otherwise time_s counts poses.
  /// Of the ground truth without a pose of the estimate, and of the estimate without one of the
  /// ground truth, by the times of the ground truth; none without times.
  LonePoses ground_truth_alone = {}, estimate_alone = {};

  Eigen::Index size() const { return time_s.size(); }
};

/// Errors of one method in one run.
struct PathErrors {
  std::string run;
  std::string method;
  PoseErrors poses;
};

}  // namespace mapproof
