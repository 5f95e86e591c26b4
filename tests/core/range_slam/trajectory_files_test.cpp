#include "core/records/observations/trajectories.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/records/observations/landmarks_csv.hpp"
#include "core/records/ranges/range_logs.hpp"
#include "tests/core/range_slam/sample_log.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;
using test::csv_folder;
using test::sample_log;

TEST(TrajectoryFiles, APathReadsBackFromCsv) {
  const RangeLog log = sample_log();
  const test::TemporaryFolder folder;
  const fs::path set = csv_folder(folder, log);
  folder.file("set/groundtruth.csv", trajectory_csv(*log.ground_truth));
  EXPECT_EQ(read_range_log(set).ground_truth->positions_m, log.ground_truth->positions_m);
}

TEST(TrajectoryFiles, TumHoldsTheHeadingAsAQuaternion) {
  const Trajectory path{.time_s = Eigen::VectorXd::Constant(1, 2.5),
                        .positions_m = Points::Constant(1, 2, -1.0),
                        .heading_rad = Eigen::VectorXd::Constant(1, std::numbers::pi)};
  EXPECT_EQ(trajectory_tum(path), "2.5 -1 -1 0 0 0 1 6.123233995736766e-17\n");
  EXPECT_THROW(trajectory_tum({.time_s = Eigen::VectorXd::Zero(2),
                               .positions_m = Points::Zero(1, 2),
                               .heading_rad = {}}),
               InvalidInput);
}

TEST(TrajectoryFiles, LandmarksReadBack) {
  Points positions(3, 2);
  positions << 1.5, 2.0, std::nan(""), 0.0, -3.0, 0.1;
  const test::TemporaryFolder folder;
  const NamedPoints read =
      read_landmarks(folder.file("l.csv", landmarks_csv({"a,b", "lost", "c"}, positions)));
  EXPECT_EQ(read.names, (std::vector<std::string>{"a,b", "c"}));
  EXPECT_EQ(read.positions_m(1, 1), 0.1);
}

}  // namespace
}  // namespace mapproof
