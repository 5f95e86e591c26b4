// What refine() is made of, piece by piece.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/range_slam/dead_reckoning.hpp"
#include "core/range_slam/refinement/key_poses.hpp"
#include "core/range_slam/refinement/refine.hpp"
#include "core/range_slam/refinement/refine_starts.hpp"
#include "core/range_slam/trilateration.hpp"
#include "tests/core/range_slam/slam_worlds.hpp"

namespace mapproof {
namespace {

using test::slam_world;

TEST(DeadReckoning, FollowsStepsThenTurns) {
  RangeLog log;
  log.start = {.time_s = 0.0, .x_m = 1.0, .y_m = 1.0, .heading_rad = 0.0};
  log.odometry = {{.time_s = 1.0,
                   .distance_m = 2.0,
                   .heading_change_rad = std::numbers::pi / 2.0,
                   .sideways_m = 0.0},
                  {.time_s = 2.0, .distance_m = 3.0, .heading_change_rad = 0.0, .sideways_m = 1.0}};
  const Trajectory path = dead_reckoned(log);
  Points expected(3, 2);
  expected << 1, 1, 3, 1, 2, 4;
  EXPECT_LT((path.positions_m - expected).cwiseAbs().maxCoeff(), 1e-12);
  log.odometry[1].time_s = 1.0;
  EXPECT_THROW(dead_reckoned(log), InvalidInput);
  EXPECT_THROW(dead_reckoned(RangeLog{}), InvalidInput);
}

TEST(KeyPoses, GiveTheDeadReckonedPathAtAnyTime) {
  const RangeLog log = slam_world(1);
  const Trajectory path = dead_reckoned(log);
  for (const double spacing_m : {0.0, 1.2, 4.0, 1e6}) {
    const KeyPoses keys(path, {}, spacing_m);
    EXPECT_EQ(keys.rows().front(), 0);
    EXPECT_EQ(keys.rows().back(), path.size() - 1);
    for (double time_s = 0.0; time_s <= 60.0; time_s += 0.25) {
      const BetweenPoses position = keys.at(time_s);
      const auto pose = [&](Eigen::Index key) -> Eigen::Vector3d {
        const Eigen::Index row = keys.rows()[static_cast<std::size_t>(key)];
        return {path.positions_m(row, 0), path.positions_m(row, 1), path.heading_rad(row)};
      };
      const Eigen::Vector3d at = position.pose(pose(position.before), pose(position.before + 1));
      const auto row = static_cast<Eigen::Index>(time_s);
      const double part = time_s - static_cast<double>(row);
      const Eigen::RowVector2d expected =
          (1.0 - part) * path.positions_m.row(row) +
          part * path.positions_m.row(std::min<Eigen::Index>(row + 1, 60));
      EXPECT_LT((at.head<2>().transpose() - expected).norm(), 1e-12);
    }
  }
}

/// Two steps put together have the covariance of many drawn ones.
TEST(KeyPoses, PutTheNoiseOfStepsTogether) {
  RangeLog log;
  log.odometry = {
      {.time_s = 1.0, .distance_m = 2.0, .heading_change_rad = 0.8, .sideways_m = 0.0},
      {.time_s = 2.0, .distance_m = 1.0, .heading_change_rad = -0.3, .sideways_m = 0.5}};
  const OdometryNoise noise{.forward_m = 0.02, .sideways_m = 0.01, .heading_change_rad = 0.02};
  const KeyPoses keys(dead_reckoned(log), noise, 1e6);
  ASSERT_EQ(keys.motions().size(), 1U);
  const Eigen::Matrix3d W = keys.motions()[0].root_information;
  Random random(3);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  constexpr int kDraws = 20'000;
  for (int draw = 0; draw < kDraws; ++draw) {
    RangeLog drawn = log;
    for (Motion& motion : drawn.odometry) {
      motion.distance_m += noise.forward_m * random.normal();
      motion.sideways_m += noise.sideways_m * random.normal();
      motion.heading_change_rad += noise.heading_change_rad * random.normal();
    }
    const Trajectory path = dead_reckoned(drawn);
    const Eigen::Vector3d end(path.positions_m(2, 0), path.positions_m(2, 1), path.heading_rad(2));
    const Eigen::Vector3d error = W * (end - keys.motions()[0].step);
    sum += error * error.transpose();
  }
  EXPECT_LT((sum / kDraws - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), 0.05);
}

/// Jacobians against central differences.
template <typename Residual>
void expect_true_jacobians(const Residual& residual, const std::vector<int>& sizes,
                           Random& random) {
  std::vector<std::vector<double>> values;
  for (const int size : sizes) {
    values.emplace_back();
    for (int i = 0; i < size; ++i) values.back().push_back(random.uniform(-2.0, 2.0));
  }
  const int rows = residual.num_residuals();
  const auto evaluate = [&](double** jacobians) {
    std::vector<const double*> parameters;
    for (const auto& block : values) parameters.push_back(block.data());
    Eigen::VectorXd out(rows);
    residual.Evaluate(parameters.data(), out.data(), jacobians);
    return out;
  };
  std::vector<std::vector<double>> blocks;
  std::vector<double*> jacobians;
  for (const int size : sizes) blocks.emplace_back(static_cast<std::size_t>(rows * size));
  for (auto& block : blocks) jacobians.push_back(block.data());
  evaluate(jacobians.data());
  for (std::size_t block = 0; block < sizes.size(); ++block)
    for (int i = 0; i < sizes[block]; ++i) {
      double& value = values[block][static_cast<std::size_t>(i)];
      const double middle = value;
      constexpr double kStep = 1e-6;
      value = middle + kStep;
      const Eigen::VectorXd above = evaluate(nullptr);
      value = middle - kStep;
      const Eigen::VectorXd below = evaluate(nullptr);
      value = middle;
      for (int row = 0; row < rows; ++row)
        EXPECT_NEAR(blocks[block][static_cast<std::size_t>(row * sizes[block] + i)],
                    (above(row) - below(row)) / (2.0 * kStep), 1e-6);
    }
}

TEST(RefineResiduals, HaveTheirCentralDifferencesAsJacobians) {
  Random random(9);
  for (int round = 0; round < 20; ++round) {
    KeyMotion motion{.step = {0.5, 0.1, 0.2}};
    motion.root_information << 3, 0, 0, 1, 2, 0, -1, 0.5, 4;
    expect_true_jacobians(MotionResidual(motion), {3, 3}, random);
    const BetweenPoses position{
        .before = 0, .share = random.uniform(), .ahead = {0.3, 0.1, 0.2}, .behind = {-0.4, 0.2, 1}};
    expect_true_jacobians(RangeResidual(position, 2.0, 0.5), {3, 3, 2, 1, 1}, random);
    expect_true_jacobians(OffsetPrior(0.3), {1}, random);
  }
}

/// Against the inverse of the whole matrix.
TEST(ChainInformation, GivesTheBlocksOfTheDenseInverse) {
  Random random(4);
  constexpr Eigen::Index kPoses = 6;
  constexpr Eigen::Index kShared = 4;
  ChainInformation information(kPoses, kShared);
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3 * kPoses + kShared, 3 * kPoses + kShared);
  for (int n = 0; n < 60; ++n) {
    const auto i = static_cast<Eigen::Index>(random.next() % kPoses) - 1;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(2, H.cols());
    Eigen::MatrixXd first(2, 3);
    Eigen::MatrixXd second(2, 3);
    Eigen::MatrixXd shared(2, 2);
    for (auto* part : {&first, &second, &shared})
      for (double& value : part->reshaped()) value = random.normal();
    const Eigen::Index column = static_cast<Eigen::Index>(random.next() % 3);
    information.add(i, first, second, {column, column + 1}, shared);
    if (i >= 0) J.middleCols(3 * i, 3) = first;
    J.middleCols(3 * (i + 1), 3) = second;
    J.middleCols(3 * kPoses + column, 2) = shared;
    H += J.transpose() * J;
  }
  const auto inverse = information.inverse();
  ASSERT_TRUE(inverse);
  const Eigen::MatrixXd expected = H.inverse();
  const double tolerance = 1e-9 * expected.cwiseAbs().maxCoeff();
  EXPECT_LT((inverse->shared - expected.bottomRightCorner(kShared, kShared)).cwiseAbs().maxCoeff(),
            tolerance);
  for (Eigen::Index i = 0; i < kPoses; ++i) {
    const auto pose = static_cast<std::size_t>(i);
    EXPECT_LT((inverse->poses[pose] - expected.block<3, 3>(3 * i, 3 * i)).cwiseAbs().maxCoeff(),
              tolerance);
    EXPECT_LT((inverse->shared_pose[pose] - expected.block(3 * kPoses, 3 * i, kShared, 3))
                  .cwiseAbs()
                  .maxCoeff(),
              tolerance);
  }
  ChainInformation nothing(2, 1);
  EXPECT_FALSE(nothing.inverse());
}

TEST(Trilateration, FindsLandmarksAlongATruePath) {
  const RangeLog log = slam_world(4, {.range_scale = 1.1});
  EXPECT_LT((trilaterated(log, *log.ground_truth, 1.1) - *log.true_landmarks).cwiseAbs().maxCoeff(),
            1e-5);
}

TEST(Trilateration, FromAStraightPathEndsOnOneOfTheTwoMirrorImages) {
  const RangeLog log = slam_world(4, {.is_straight = true});
  const Points positions = trilaterated(log, *log.ground_truth);
  const Eigen::RowVector2d along(std::cos(0.3), std::sin(0.3));
  const Eigen::RowVector2d origin(1.0, -2.0);
  for (Eigen::Index n = 0; n < 4; ++n) {
    const Eigen::RowVector2d gap = log.true_landmarks->row(n) - origin;
    const Eigen::RowVector2d mirrored = origin + 2.0 * gap.dot(along) * along - gap;
    EXPECT_LT(std::min((positions.row(n) - log.true_landmarks->row(n)).norm(),
                       (positions.row(n) - mirrored).norm()),
              1e-4);
  }
}

}  // namespace
}  // namespace mapproof
