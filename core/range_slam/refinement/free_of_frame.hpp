#pragma once

#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// A map whose frame its first pose holds, and where its landmarks stand among the numbers that a
/// covariance is of.
struct FramedMap {
  const std::vector<Eigen::Vector3d>& poses;      ///< x, y, heading.
  const std::vector<Eigen::Vector2d>& landmarks;  ///< N.
  const std::vector<Eigen::Index>& columns;       ///< N; -1: not among them.
};

/// Removes the share of the first pose's error from covariances where landmarks and poses are free
/// to move together: they are then those after a rigid fit of the landmarks.
/// @param shared       m x m. @param poses  Of the poses. @param shared_pose  m x 3 between both.
/// @return False if fewer than two landmark positions are free: nothing is removed.
bool free_of_frame(const FramedMap& map, Eigen::MatrixXd& shared,
                   std::vector<Eigen::Matrix3d>& poses,
                   const std::vector<Eigen::MatrixXd>& shared_pose);

}  // namespace mapproof
