#include <gtest/gtest.h>

#include <cmath>

#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/factors/spectral_slam.hpp"
#include "core/score/trajectory_error.hpp"
#include "tests/support/plaza.hpp"
#include "tests/support/slam_checks.hpp"

namespace mapproof {
namespace {

struct PlazaTarget {
  const char* name;
  double free_m;       ///< No landmark known, best rigid motion.
  double known_m;      ///< Four known, as it is.
  double landmarks_m;  ///< Of the landmarks where none is known.
};

class PlazaSlam : public ::testing::TestWithParam<PlazaTarget> {};

TEST_P(PlazaSlam, ReachesItsErrorsWithWindowsChosenWithoutGroundTruth) {
  const std::optional<RangeLog> log = test::plaza(GetParam().name);
  if (!log) GTEST_SKIP() << test::kNoPlaza;
  const Trajectory odometry = dead_reckoned(*log);
  const SpectralSlam free = spectral_slam(*log, odometry);
  EXPECT_EQ(free.estimate.path.size(), odometry.size());
  EXPECT_TRUE(free.estimate.statuses.empty());
  EXPECT_LT(test::mean_error_m(*log, free.estimate, Alignment::kRigid), GetParam().free_m);
  EXPECT_NEAR(free.estimate.range_scale, 1.07, 0.02);
  const auto error =
      trajectory_error(free.estimate, *log->ground_truth, log->true_landmarks, Alignment::kRigid);
  EXPECT_LT(*error->landmarks_m, GetParam().landmarks_m);
  for (const bool with_heading : {false, true}) {
    const SpectralSlam known = spectral_slam(
        *log, odometry, {.known = test::all_known(*log), .with_heading = with_heading});
    EXPECT_LT(test::mean_error_m(*log, known.estimate, Alignment::kNone), GetParam().known_m);
    if (with_heading) {
      // Modulo pi: the true headings of Plaza 2 are turned about.
      const Eigen::ArrayXd off = known.estimate.path.heading_rad - log->ground_truth->heading_rad;
      EXPECT_LT(off.sin().abs().mean(), 0.06);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sets, PlazaSlam,
                         ::testing::Values(PlazaTarget{"plaza1", 0.47, 0.68, 1.5},
                                           PlazaTarget{"plaza2", 0.30, 0.35, 0.5}),
                         [](const auto& set) { return std::string(set.param.name); });

}  // namespace
}  // namespace mapproof
