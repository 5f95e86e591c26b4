#pragma once

#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// The rigid motion of least squares between positions on a map and what one scan saw of them.
class ScanPose {
 public:
  ScanPose() = default;
  /// @param mapped_m  Two positions or more, as many as `seen_m`.
  ScanPose(const std::vector<Eigen::RowVector2d>& mapped_m,
           const std::vector<Eigen::RowVector2d>& seen_m);

  Eigen::RowVector2d to_robot(const Eigen::RowVector2d& position_m) const {
    return (position_m - mapped_mean_m_) * turn_ + seen_mean_m_;
  }
  Eigen::RowVector2d to_map(const Eigen::RowVector2d& position_m) const {
    return (position_m - seen_mean_m_) * turn_.transpose() + mapped_mean_m_;
  }

  /// Root mean square distance of the positions from their mean: the base of the rotation.
  double extent_m() const { return extent_m_; }
  const Eigen::RowVector2d& seen_mean_m() const { return seen_mean_m_; }

 private:
  Eigen::Matrix2d turn_ = Eigen::Matrix2d::Identity();  ///< Row vectors: to the robot's frame.
  Eigen::RowVector2d seen_mean_m_ = Eigen::RowVector2d::Zero();
  Eigen::RowVector2d mapped_mean_m_ = Eigen::RowVector2d::Zero();
  double extent_m_ = 0.0;
};

}  // namespace mapproof
