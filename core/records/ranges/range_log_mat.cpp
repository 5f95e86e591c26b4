#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/records/observations/mat_tables.hpp"
#include "core/records/observations/path_motions.hpp"
#include "core/records/ranges/range_log_files.hpp"
#include "core/records/ranges/range_log_parts.hpp"
#include "core/records/ranges/range_log_readers.hpp"

namespace mapproof {
namespace {

using Tables = std::map<std::string, NumberTable>;

/// The table, if it is there. @throws IoError if it has rows but other than `columns` columns.
const NumberTable* table_of(const Tables& tables, const std::string& name, Eigen::Index columns) {
  const auto found = tables.find(name);
  if (found == tables.end() || found->second.values.rows() == 0) return nullptr;
  if (found->second.values.cols() != columns)
    throw IoError(found->second.source, "variable " + name,
                  fmt::format("{} columns, expected {}", found->second.values.cols(), columns));
  return &found->second;
}

bool has_same_times(const NumberTable& path, const NumberTable& motions) {
  const Eigen::Index steps = motions.values.rows();
  return path.values.rows() == steps + 1 && path.values.col(0).tail(steps) == motions.values.col(0);
}

/// The positions of DRp are what the robot's own gyro gave, whatever stands in DR.
void take_odometry(const Tables& tables, OdometrySource source, RangeLogParts& parts) {
  const NumberTable* motions = table_of(tables, "DR", 3);
  const NumberTable* path = table_of(tables, "DRp", 4);
  if (motions != nullptr) parts.odometry = motions_in(*motions);
  if (path == nullptr || path->values.rows() < 2) {
    if (motions != nullptr)
      parts.remarks.push_back("There is no DRp: the odometry is DR as it stands.");
    return;
  }
  const Trajectory dead_reckoned = trajectory_in(*path);
  if (source == OdometrySource::kAsGiven && motions != nullptr) {
    parts.start = {.time_s = dead_reckoned.time_s(0),
                   .x_m = dead_reckoned.positions_m(0, 0),
                   .y_m = dead_reckoned.positions_m(0, 1),
                   .heading_rad = dead_reckoned.heading_rad(0)};
    return;
  }
  std::vector<double> distances_m;
  if (motions != nullptr && has_same_times(*path, *motions))
    for (const Motion& motion : parts.odometry) distances_m.push_back(motion.distance_m);
  RecoveredOdometry recovered = motions_along(dead_reckoned, distances_m);
  parts.start = recovered.start;
  parts.odometry = std::move(recovered.motions);
  parts.remarks.push_back("The odometry is recovered from the positions in DRp.");
}

/// What stands in DR is worth a word even where it is not used.
void check_given_turns(const Tables& tables, RangeLogParts& parts) {
  const NumberTable* motions = table_of(tables, "DR", 3);
  const NumberTable* truth = table_of(tables, "GT", 4);
  if (motions == nullptr || truth == nullptr) return;
  if (turns_are_the_truths(motions_in(*motions), trajectory_in(*truth)))
    parts.remarks.push_back(
        "The heading increments of DR are those of the true heading, not the robot's gyro.");
}

}  // namespace

RangeLog read_range_log_mat(ByteSource& source, const RangeLogOptions& options) {
  const Tables tables = read_mat_tables(source);
  RangeLogParts parts{.source = source.name(), .name = options.name};
  const NumberTable* ranges = table_of(tables, "TD", 4);
  if (ranges == nullptr)
    throw IoError(parts.source, "has no variable TD of ranges: time, sender, landmark, range");
  check_one_sender(*ranges, 1);
  parts.readings = readings_in(selected(*ranges, {0, 3}, 2));
  take_odometry(tables, options.odometry, parts);
  check_given_turns(tables, parts);
  if (const NumberTable* truth = table_of(tables, "GT", 4)) parts.truth = trajectory_in(*truth);
  if (const NumberTable* landmarks = table_of(tables, "TL", 3))
    parts.true_landmarks = landmarks_in(selected(*landmarks, {1, 2}, 0));
  return assemble(std::move(parts), options);
}

}  // namespace mapproof
