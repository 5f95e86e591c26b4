#include "tests/app/range_logs.hpp"

#include "core/base/files/files.hpp"
#include "tests/core/range_slam/drives.hpp"
#include "tests/core/range_slam/sample_log.hpp"

namespace mapproof::test {

RangeLog drive_log() {
  Drive made = drive({.range_sigma_m = 0.1, .range_scale = 1.05, .gyro_drift = 0.0}, 3);
  RangeLog& log = made.log;
  const Trajectory& ground_truth = *log.ground_truth;
  log.start = {.time_s = ground_truth.time_s(0),
               .x_m = ground_truth.positions_m(0, 0),
               .y_m = ground_truth.positions_m(0, 1),
               .heading_rad = ground_truth.heading_rad(0)};
  for (Eigen::Index t = 1; t < ground_truth.size(); ++t)
    log.odometry.push_back(
        {.time_s = ground_truth.time_s(t),
         .distance_m =
             (ground_truth.positions_m.row(t) - ground_truth.positions_m.row(t - 1)).norm(),
         .heading_change_rad = ground_truth.heading_rad(t) - ground_truth.heading_rad(t - 1),
         .sideways_m = 0.0});
  return log;
}

void write_log(const RangeLog& log, const std::filesystem::path& folder, const LogFiles& files) {
  write_file(folder / "ranges.csv", ranges_csv_of(log));
  if (files.odometry && !log.odometry.empty()) {
    write_file(folder / "odometry.csv", odometry_csv_of(log));
    write_file(folder / "odometry_start.csv", start_csv_of(log));
  }
  if (files.ground_truth) write_file(folder / "groundtruth.csv", ground_truth_csv_of(log));
  if (files.landmarks) write_file(folder / "landmarks.csv", landmarks_csv_of(log));
}

RangeLog log_of_common_times() {
  RangeLog log = drive_log();
  log.odometry.clear();
  log.ranges.clear();
  const Trajectory& ground_truth = *log.ground_truth;
  for (Eigen::Index t = 0; t < ground_truth.size(); t += 10)
    for (Eigen::Index n = 0; n < log.true_landmarks->rows(); ++n)
      log.ranges.push_back(
          {.time_s = ground_truth.time_s(t),
           .landmark = n,
           .range_m = (log.true_landmarks->row(n) - ground_truth.positions_m.row(t)).norm()});
  return log;
}

}  // namespace mapproof::test
