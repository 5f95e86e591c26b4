#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/range_log.hpp"
#include "core/records/ranges/range_tables.hpp"
#include "core/records/tables/column_names.hpp"

namespace mapproof {

/// What the readers of the several formats gather before a log is made of it.
struct RangeLogParts {
  std::string source;  ///< File or folder, for errors.
  std::string name;
  std::vector<NamedMeasurement> measurements = {};  ///< In the order of the file.
  std::vector<Motion> odometry = {};
  std::optional<StartPose> start = {};
  std::optional<Trajectory> ground_truth = {};
  NamedPoints true_landmarks = {};
  std::vector<std::string> remarks = {};
  ColumnNames columns = {};              ///< That the user names; marked once a table has them.
  std::vector<std::string> header = {};  ///< Of the table of ranges.
  /// What is read of that table, see RangeLog.
  std::vector<std::pair<std::string, std::string>> read = {};
  char separator = '\0';
};

/// The times of the poses of the odometry: its start, then the end of each motion.
Eigen::VectorXd pose_times(const RangeLogParts& parts);

/// On odometry that seems to be in degrees, or the whole way since the start.
std::vector<std::string> odometry_remarks(const std::vector<Motion>& motions);

}  // namespace mapproof
