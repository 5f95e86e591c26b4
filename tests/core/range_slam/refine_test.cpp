#include "core/range_slam/refine.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/base/errors.hpp"
#include "core/range_slam/refine_starts.hpp"
#include "core/records/range_log_files.hpp"
#include "core/score/trajectory_error.hpp"
#include "tests/core/range_slam/slam_worlds.hpp"

namespace mapproof {
namespace {

using test::slam_world;

double error_of(const RangeLog& log, const SlamEstimate& estimate, Alignment alignment) {
  return trajectory_error(estimate, *log.truth, log.true_landmarks, alignment)->mean_m;
}

bool has_status(const SlamEstimate& estimate, StatusCode code) {
  for (const Status& status : estimate.statuses)
    if (status.code == code) return true;
  return false;
}

SlamEstimate truth_as_start(const RangeLog& log) {
  SlamEstimate start;
  start.path = *log.truth;
  start.landmarks_m = *log.true_landmarks;
  return start;
}

RangeLog noisy_world(std::uint64_t seed, Eigen::Index steps = 60) {
  return slam_world(seed, {.steps = steps,
                           .range_sigma_m = 0.2,
                           .distance_sigma_m = 0.02,
                           .turn_sigma_rad = 0.01,
                           .range_scale = 1.05});
}

/// The same problem written down a second time: dense, numeric Jacobians, Gauss and Newton's steps.
struct DenseProblem {
  const RangeLog& log;
  RefineOptions options;
  Eigen::Index poses = static_cast<Eigen::Index>(log.odometry.size()) + 1;
  Eigen::Index landmarks = static_cast<Eigen::Index>(log.landmarks.size());

  Eigen::Index size() const { return 3 * (poses - 1) + 2 * landmarks + 1; }

  Eigen::VectorXd packed(const SlamEstimate& estimate) const {
    Eigen::VectorXd x(size());
    for (Eigen::Index i = 1; i < poses; ++i)
      x.segment<3>(3 * (i - 1)) << estimate.path.positions_m(i, 0), estimate.path.positions_m(i, 1),
          estimate.path.heading_rad(i);
    for (Eigen::Index n = 0; n < landmarks; ++n)
      x.segment<2>(3 * (poses - 1) + 2 * n) = estimate.landmarks_m.row(n).transpose();
    x(size() - 1) = estimate.range_scale;
    return x;
  }

  Eigen::Vector3d pose(const Eigen::VectorXd& x, Eigen::Index i) const {
    if (i == 0) return {log.start.x_m, log.start.y_m, log.start.heading_rad};
    return x.segment<3>(3 * (i - 1));
  }

  /// Whitened; ranges by the root of Huber's weight at `weighted_at`.
  Eigen::VectorXd residuals(const Eigen::VectorXd& x, const Eigen::VectorXd& weighted_at) const {
    const auto motions = static_cast<Eigen::Index>(log.odometry.size());
    Eigen::VectorXd r(3 * motions + static_cast<Eigen::Index>(log.ranges.size()));
    for (Eigen::Index i = 0; i < motions; ++i) {
      const Motion& motion = log.odometry[static_cast<std::size_t>(i)];
      const Eigen::Vector3d a = pose(x, i);
      const Eigen::Vector3d b = pose(x, i + 1);
      const double dx = b(0) - a(0);
      const double dy = b(1) - a(1);
      r(3 * i) = (std::cos(a(2)) * dx + std::sin(a(2)) * dy - motion.distance_m) / 0.02;
      r(3 * i + 1) = (-std::sin(a(2)) * dx + std::cos(a(2)) * dy - motion.sideways_m) / 0.02;
      r(3 * i + 2) = (b(2) - a(2) - motion.turn_rad) / 0.005;
    }
    for (std::size_t k = 0; k < log.ranges.size(); ++k) {
      const double at = range_residual(weighted_at, k);
      const double weight = std::abs(at) > options.huber ? options.huber / std::abs(at) : 1.0;
      r(3 * motions + static_cast<Eigen::Index>(k)) = std::sqrt(weight) * range_residual(x, k);
    }
    return r;
  }

  double range_residual(const Eigen::VectorXd& x, std::size_t k) const {
    const RangeReading& reading = log.ranges[k];
    const Eigen::Vector3d at = pose(x, std::lround(reading.time_s));
    const Eigen::Vector2d place = x.segment<2>(3 * (poses - 1) + 2 * reading.landmark);
    return (x(size() - 1) * (at.head<2>() - place).norm() - reading.range_m) /
           options.range_sigma_m;
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const {
    constexpr double kStep = 1e-6;
    Eigen::MatrixXd J(residuals(x, x).size(), size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      Eigen::VectorXd above = x;
      Eigen::VectorXd below = x;
      above(i) += kStep;
      below(i) -= kStep;
      J.col(i) = (residuals(above, x) - residuals(below, x)) / (2.0 * kStep);
    }
    return J;
  }
};

TEST(Refine, EndsWhereDenseGaussNewtonEnds) {
  const RangeLog log = noisy_world(2, 24);
  const RefineOptions options{.range_sigma_m = 0.2, .covariances = 25};
  const SlamEstimate refined = refine(log, truth_as_start(log), options);
  EXPECT_TRUE(refined.statuses.empty());
  const DenseProblem dense{.log = log, .options = options};
  Eigen::VectorXd x = dense.packed(truth_as_start(log));
  for (int round = 0; round < 100; ++round) {
    const Eigen::MatrixXd J = dense.jacobian(x);
    x -= (J.transpose() * J).ldlt().solve(J.transpose() * dense.residuals(x, x));
  }
  EXPECT_LT((dense.packed(refined) - x).cwiseAbs().maxCoeff(), 1e-4);
}

/// After a rigid fit of the landmarks; against the dense inverse.
TEST(Refine, CovariancesAreTheDenseOnesFreedOfTheFrame) {
  const RangeLog log = noisy_world(2, 24);
  const RefineOptions options{.range_sigma_m = 0.2, .covariances = 25};
  const SlamEstimate refined = refine(log, truth_as_start(log), options);
  const DenseProblem dense{.log = log, .options = options};
  const Eigen::MatrixXd J = dense.jacobian(dense.packed(refined));
  const Eigen::MatrixXd covariance = (J.transpose() * J).inverse();
  // The errors less the rigid motion that fits those of the landmarks best.
  const Eigen::Index first = 3 * (dense.poses - 1);
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(dense.size(), 3);
  const auto fill = [&](Eigen::Index row, const Eigen::RowVector2d& place) {
    moves.block<2, 3>(row, 0) << 1, 0, -place(1), 0, 1, place(0);
  };
  for (Eigen::Index i = 1; i < dense.poses; ++i) fill(3 * (i - 1), refined.path.positions_m.row(i));
  for (Eigen::Index n = 0; n < dense.landmarks; ++n)
    fill(first + 2 * n, refined.landmarks_m.row(n));
  const Eigen::MatrixXd G = moves.middleRows(first, 2 * dense.landmarks);
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(dense.size(), dense.size());
  P.middleCols(first, 2 * dense.landmarks) -= moves * (G.transpose() * G).inverse() * G.transpose();
  const Eigen::MatrixXd freed = P * covariance * P.transpose();
  for (Eigen::Index n = 0; n < dense.landmarks; ++n) {
    const Eigen::Matrix2d expected = freed.block<2, 2>(first + 2 * n, first + 2 * n);
    EXPECT_LT((refined.landmark_cov_m2[static_cast<std::size_t>(n)] - expected).norm(),
              1e-5 * expected.norm());
  }
  ASSERT_EQ(refined.position_cov_rows.size(), 25U);
  for (std::size_t i = 1; i < 25; ++i) {
    const Eigen::Index row = 3 * (refined.position_cov_rows[i] - 1);
    const Eigen::Matrix2d expected = freed.block<2, 2>(row, row);
    EXPECT_LT((refined.position_cov_m2[i] - expected).norm(), 1e-5 * expected.norm());
  }
}

/// Errors over many draws of the noise are as large as the covariances say.
TEST(Refine, CovariancesAreThoseOfManyDraws) {
  double squared = 0.0;
  constexpr int kDraws = 150;
  for (int draw = 0; draw < kDraws; ++draw) {
    const RangeLog log =
        slam_world(100 + static_cast<std::uint64_t>(draw),
                   {.range_sigma_m = 0.05, .distance_sigma_m = 0.02, .turn_sigma_rad = 0.005});
    const RefineOptions options{.range_sigma_m = 0.05, .huber = 100.0, .covariances = 1};
    const SlamEstimate refined = refine(log, truth_as_start(log), options);
    const Similarity motion =
        fit_similarity(refined.landmarks_m, *log.true_landmarks, Alignment::kRigid);
    const Eigen::RowVector2d error =
        motion(refined.landmarks_m).row(1) - log.true_landmarks->row(1);
    // Turned into the frame of the estimate, whose covariance it is.
    const Eigen::Vector2d own = motion.rotation.transpose() * error.transpose();
    squared += own.dot(refined.landmark_cov_m2[1].inverse() * own);
  }
  EXPECT_NEAR(squared / (2.0 * kDraws), 1.0, 0.2);
}

TEST(Refine, FindsTheWorldAndTheScaleWithoutNoise) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const RangeLog log = slam_world(seed, {.range_scale = 1.07});
    const SlamEstimate refined = refine(log, dead_reckoning_start(log));
    EXPECT_LT(error_of(log, refined, Alignment::kNone), 1e-6);
    EXPECT_NEAR(refined.range_scale, 1.07, 1e-6);
    EXPECT_LT((refined.landmarks_m - *log.true_landmarks).cwiseAbs().maxCoeff(), 1e-5);
    EXPECT_TRUE(refined.statuses.empty());
  }
}

TEST(Refine, IsBetterThanDeadReckoningAndTheSameFromEveryStart) {
  const RangeLog log = slam_world(
      5, {.steps = 300, .range_sigma_m = 0.2, .distance_sigma_m = 0.02, .turn_sigma_rad = 0.02});
  const RefineOptions options{.odometry = {.turn_rad = 0.02}, .range_sigma_m = 0.2};
  const SlamEstimate start = dead_reckoning_start(log);
  const SlamEstimate refined = refine(log, start, options);
  EXPECT_LT(error_of(log, refined, Alignment::kRigid), 0.15);
  EXPECT_LT(error_of(log, refined, Alignment::kRigid),
            0.3 * error_of(log, start, Alignment::kRigid));
  const SlamEstimate from_truth = refine(log, truth_as_start(log), options);
  EXPECT_NEAR(*refined.cost, *from_truth.cost, 1e-4 * *refined.cost);
  SlamEstimate without_headings = truth_as_start(log);
  without_headings.path.heading_rad.resize(0);
  EXPECT_NEAR(*refine(log, without_headings, options).cost, *refined.cost, 1e-4 * *refined.cost);
  SlamEstimate sparse = truth_as_start(log);
  const std::vector<Eigen::Index> rows = {20, 90, 160, 280};
  sparse.path = {.time_s = log.truth->time_s(rows),
                 .positions_m = log.truth->positions_m(rows, Eigen::all),
                 .heading_rad = {}};
  EXPECT_NEAR(*refine(log, sparse, options).cost, *refined.cost, 1e-4 * *refined.cost);
}

TEST(Refine, AFewPosesAreNearlyAsGoodAsAll) {
  const RangeLog log = noisy_world(7, 300);
  RefineOptions options{.range_sigma_m = 0.2};
  const SlamEstimate all = refine(log, dead_reckoning_start(log), options);
  options.spacing_m = 3.0;
  const SlamEstimate few = refine(log, dead_reckoning_start(log), options);
  EXPECT_EQ(few.path.size(), all.path.size());
  EXPECT_LT((few.path.positions_m - all.path.positions_m).rowwise().norm().maxCoeff(), 0.1);
}

TEST(Refine, KnownLandmarksTieTheFrame) {
  RangeLog log = noisy_world(8);
  log.start = {.time_s = 0.0, .x_m = 70.0, .y_m = 0.0, .heading_rad = 2.0};  // Of another frame.
  RefineOptions options{.range_sigma_m = 0.2, .covariances = 3};
  options.known =
      KnownLandmarks{.rows = {0, 2}, .positions_m = (*log.true_landmarks)({0, 2}, Eigen::all)};
  const SlamEstimate refined = refine(log, dead_reckoning_start(log), options);
  EXPECT_LT(error_of(log, refined, Alignment::kNone), 0.5);
  EXPECT_EQ(refined.landmarks_m.row(2), log.true_landmarks->row(2));
  EXPECT_EQ(refined.landmark_cov_m2[0], Eigen::Matrix2d::Zero());
  EXPECT_GT(refined.landmark_cov_m2[1].trace(), 0.0);
}

TEST(Refine, OffsetsOfALandmarkAreFound) {
  RangeLog log = slam_world(3);
  for (RangeReading& reading : log.ranges)
    if (reading.landmark == 1) reading.range_m += 0.4;
  const RefineOptions options{
      .range_sigma_m = 0.01, .estimate_scale = false, .offset_sigma_m = 1.0};
  const SlamEstimate refined = refine(log, truth_as_start(log), options);
  ASSERT_EQ(refined.range_offsets_m.size(), 4);
  EXPECT_NEAR(refined.range_offsets_m(1), 0.4, 0.02);
  EXPECT_NEAR(refined.range_offsets_m(2), 0.0, 0.02);
}

TEST(Refine, GivesTheSameBitsEveryTime) {
  const RangeLog log = noisy_world(4);
  const SlamEstimate first = refine(log, random_start(log, 3), {.covariances = 5});
  const SlamEstimate second = refine(log, random_start(log, 3), {.covariances = 5});
  EXPECT_EQ(first.path.positions_m, second.path.positions_m);
  EXPECT_EQ(first.landmarks_m, second.landmarks_m);
  EXPECT_EQ(first.landmark_cov_m2, second.landmark_cov_m2);
}

TEST(Refine, SaysNothingOnAnyStream) {
  const RangeLog log = noisy_world(4);
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  refine(log, random_start(log, 1), {.most_iterations = 1});
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Refine, HardDataEndInAStatus) {
  RangeLog log = noisy_world(6);
  EXPECT_TRUE(has_status(refine(log, random_start(log, 2), {.most_iterations = 1}),
                         StatusCode::kNotConverged));

  RangeLog unheard = log;
  unheard.landmarks.push_back("silent");
  unheard.true_landmarks.reset();
  const SlamEstimate without = refine(unheard, dead_reckoning_start(unheard), {.covariances = 2});
  EXPECT_TRUE(has_status(without, StatusCode::kLandmarkUnseen));
  EXPECT_TRUE(std::isnan(without.landmarks_m(4, 0)));
  EXPECT_TRUE(without.landmarks_m.topRows(4).allFinite());

  RangeLog once = log;
  once.ranges.resize(1);
  SlamEstimate start = truth_as_start(once);
  const SlamEstimate loose = refine(once, start, {.covariances = 2});
  EXPECT_TRUE(has_status(loose, StatusCode::kUndetermined));
  EXPECT_TRUE(loose.landmark_cov_m2.empty());
  EXPECT_TRUE(loose.path.positions_m.allFinite());

  RangeLog huge = log;
  for (RangeReading& reading : huge.ranges) reading.range_m = 1e6;
  EXPECT_TRUE(refine(huge, dead_reckoning_start(huge)).path.positions_m.allFinite());

  RangeLog still = log;
  for (Motion& motion : still.odometry) motion = {.time_s = motion.time_s};
  EXPECT_TRUE(refine(still, dead_reckoning_start(still)).path.positions_m.allFinite());
}

TEST(Refine, BrokenBoundsAreRefused) {
  const RangeLog log = noisy_world(1);
  const SlamEstimate start = dead_reckoning_start(log);
  EXPECT_THROW(refine(log, start, {.range_sigma_m = 0.0}), InvalidInput);
  EXPECT_THROW(refine(log, start, {.spacing_m = -1.0}), InvalidInput);
  EXPECT_THROW(refine(log, start, {.huber = std::nan("")}), InvalidInput);
  EXPECT_THROW(refine(log, start, {.most_iterations = 0}), InvalidInput);
  EXPECT_THROW(refine(log, {}, {}), InvalidInput);
  RangeLog none = log;
  none.ranges.clear();
  EXPECT_THROW(refine(none, start), InvalidInput);
  none = log;
  none.odometry.clear();
  EXPECT_THROW(refine(none, start), InvalidInput);
  RangeLog crowded = log;
  crowded.landmarks.resize(501);
  SlamEstimate many = start;
  many.landmarks_m = Points::Zero(501, 2);
  EXPECT_THROW(refine(crowded, many, {.covariances = 1}), InvalidInput);
  RefineOptions options;
  options.known = KnownLandmarks{.rows = {0}, .positions_m = Points::Zero(1, 2)};
  EXPECT_THROW(refine(log, start, options), InvalidInput);
}

class PlazaRefinement : public ::testing::TestWithParam<const char*> {};

TEST_P(PlazaRefinement, ComesWithinTwentyCentimetres) {
  const char* folder = std::getenv("MAPPROOF_PLAZA");
  if (folder == nullptr) GTEST_SKIP() << "MAPPROOF_PLAZA does not name the folder of the sets";
  const RangeLog log = read_range_log(std::filesystem::path(folder) / GetParam());
  const bool is_first = std::string(GetParam()) == "plaza1";
  const SlamEstimate start = dead_reckoning_start(log);
  EXPECT_NEAR(error_of(log, start, Alignment::kNone), is_first ? 15.92 : 27.03, 0.01);
  const SlamEstimate refined = refine(log, start);
  EXPECT_TRUE(refined.statuses.empty());
  EXPECT_LT(error_of(log, refined, Alignment::kRigid), is_first ? 0.20 : 0.19);
  EXPECT_NEAR(refined.range_scale, is_first ? 1.065 : 1.067, 0.002);
  const SlamEstimate fixed = refine(log, start, {.estimate_scale = false});
  EXPECT_NEAR(error_of(log, fixed, Alignment::kRigid), is_first ? 1.14 : 1.51, 0.02);
  const SlamEstimate random = refine(log, random_start(log, 1));
  EXPECT_NEAR(*random.cost, *refined.cost, 1e-3 * *refined.cost);
}

INSTANTIATE_TEST_SUITE_P(Both, PlazaRefinement, ::testing::Values("plaza1", "plaza2"));

}  // namespace
}  // namespace mapproof
