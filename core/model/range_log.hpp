#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// One measured distance from the robot to a landmark.
struct RangeMeasurement {
  double time_s = 0.0;
  Eigen::Index landmark = 0;  ///< Row in RangeLog::landmarks.
  double range_m = 0.0;
  double sigma_m = 0.0;  ///< Standard deviation, as the log gives it; 0: not given.
};

/// Motion of the robot from the pose before to the pose at `time_s`: first forward along the
/// heading before and leftwards across it, then the heading change.
struct Motion {
  double time_s = 0.0;
  double distance_m = 0.0;
  double heading_change_rad = 0.0;
  double sideways_m = 0.0;  ///< To the left; 0 for what has wheels.
  /// Standard deviations forward [m], sideways [m], of the heading [rad], as the log gives them.
  std::optional<Eigen::Vector3d> sigmas = std::nullopt;
};

/// Poses over time, T of them.
struct Trajectory {
  Eigen::VectorXd time_s;       ///< T, ascending.
  Points positions_m;           ///< T x 2.
  Eigen::VectorXd heading_rad;  ///< T, or empty where headings are not known.

  Eigen::Index size() const { return time_s.size(); }
};

/// Why a path is not valid: sizes that differ, or times that are not finite or do not
/// ascend; empty if nothing. Positions and headings may be NaN: not known.
std::string times_problem(const Trajectory& path);

/// The same, or a position or heading that is not finite.
std::string path_problem(const Trajectory& path);

/// Where integrated odometry begins.
struct StartPose {
  double time_s = 0.0;
  double x_m = 0.0;
  double y_m = 0.0;
  double heading_rad = 0.0;
};

/// What a robot recorded on its way: odometry and ranges, and the ground truth where it was
/// surveyed.
struct RangeLog {
  std::string name;                      ///< For titles, e.g. "Plaza 1".
  std::vector<std::string> landmarks;    ///< Names, N of them, all different.
  std::vector<RangeMeasurement> ranges;  ///< Ascending in time.
  StartPose start;               ///< Zero where the log has none: the frame is then its own.
  std::vector<Motion> odometry;  ///< Ascending in time; empty: no odometry.
  std::optional<Trajectory> ground_truth;  ///< The surveyed path.
  std::optional<Points> true_landmarks;    ///< N x 2, m; NaN rows: not surveyed.
  std::vector<std::string> remarks;        ///< What the reader did or noticed, a sentence each.
  /// Of the table of ranges: role and header of each column that is read, and what separates cells.
  /// Empty and 0: the log is not a table.
  std::vector<std::pair<std::string, std::string>> columns = {};
  char separator = '\0';
};

}  // namespace mapproof
