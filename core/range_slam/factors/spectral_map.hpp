#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// Landmarks and robot positions read off squared ranges, Y = C X.
struct SpectralMap {
  Eigen::MatrixXd C =
      Eigen::MatrixXd(0, 4);  ///< N x (d + 2), as landmark_states(); no row: no map came out.
  Eigen::MatrixXd X = Eigen::MatrixXd(4, 0);  ///< (d + 2) x T, as robot_states(); or no column.
  double range_scale = 1.0;           ///< Measured range over distance, where it can be determined.
  std::optional<double> condition{};  ///< Of the regression or upgrade that fixed the coordinates.
  std::vector<Status> statuses{};     ///< Empty if all went well.

  bool empty() const { return C.rows() == 0; }
};

/// Positions of landmarks, N x 2, in rows [|m|^2/2, m_x, m_y, 1] that noise may have moved.
Points landmarks_of(const Eigen::MatrixXd& C);

/// Positions of the robot, T x 2, in columns [1, -x, -y, (x^2 + y^2)/2] that noise may have moved.
Points positions_of(const Eigen::MatrixXd& X);

/// The same in space: N x 3 in rows of 5, T x 3 in columns of 5.
SpacePoints space_landmarks_of(const Eigen::MatrixXd& C);
SpacePoints space_positions_of(const Eigen::MatrixXd& X);

}  // namespace mapproof
