#include "core/score/trajectory_error.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include <Eigen/Geometry>
#include <numbers>

#include "core/align/path_at.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"

namespace mapproof {
namespace {

Points random_points(Eigen::Index n, Random& random) {
  Points points(n, 2);
  for (double& value : points.reshaped()) value = random.uniform(-5.0, 5.0);
  return points;
}

Similarity random_similarity(Random& random, double scale, bool is_mirrored) {
  const double angle = random.uniform(-3.0, 3.0);
  Similarity map{.scale = scale};
  map.rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  if (is_mirrored) map.rotation.col(1) *= -1.0;
  map.offset << random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0);
  return map;
}

Trajectory straight_path(Eigen::Index n) {
  Trajectory path{.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)),
                  .positions_m = Points::Zero(n, 2),
                  .heading_rad = {}};
  path.positions_m.col(0) = path.time_s;
  return path;
}

SlamEstimate estimate_of(const Trajectory& path) {
  SlamEstimate estimate;
  estimate.path = path;
  return estimate;
}

RC_GTEST_PROP(Rigid, UndoesTheMotionOfItsKind, ()) {
  Random random(*rc::gen::arbitrary<std::uint64_t>());
  const Points from = random_points(*rc::gen::inRange(3, 20), random);
  for (const auto alignment :
       {Alignment::kRigid, Alignment::kRigidWithReflection, Alignment::kSimilarity}) {
    const Similarity motion =
        random_similarity(random, alignment == Alignment::kSimilarity ? 2.5 : 1.0,
                          alignment == Alignment::kRigidWithReflection);
    const Similarity fitted = fit_similarity(from, motion(from), alignment);
    RC_ASSERT((fitted(from) - motion(from)).cwiseAbs().maxCoeff() < 1e-11);
  }
}

/// Rigid motions a little off the fitted one fit worse.
TEST(Rigid, NoNeighbouringMotionFitsBetter) {
  Random random(5);
  const Points from = random_points(30, random);
  const Points to = random_points(30, random);
  for (const auto alignment :
       {Alignment::kRigid, Alignment::kRigidWithReflection, Alignment::kSimilarity}) {
    const Similarity best = fit_similarity(from, to, alignment);
    const double least = (best(from) - to).squaredNorm();
    for (const double step : {-1e-3, 1e-3}) {
      Similarity other = best;
      other.rotation = Eigen::Rotation2Dd(step).toRotationMatrix() * best.rotation;
      EXPECT_GT((other(from) - to).squaredNorm(), least - 1e-9);
      other = best;
      other.offset(0) += step;
      EXPECT_GT((other(from) - to).squaredNorm(), least);
      other = best;
      other.scale += step;
      if (alignment == Alignment::kSimilarity) {
        EXPECT_GT((other(from) - to).squaredNorm(), least);
      }
    }
  }
}

TEST(Rigid, AMirrorIsAllowedOnlyWhereItIsAskedFor) {
  Random random(3);
  const Points from = random_points(9, random);
  Points to = from;
  to.col(1) *= -1.0;
  EXPECT_LT(fit_similarity(from, to, Alignment::kRigidWithReflection).rotation.determinant(), 0.0);
  EXPECT_GT(fit_similarity(from, to, Alignment::kRigid).rotation.determinant(), 0.0);
  EXPECT_GT(fit_similarity(from, to, Alignment::kSimilarity).rotation.determinant(), 0.0);
}

TEST(Rigid, PointsInOnePlaceAreShiftedAlone) {
  const Similarity map = fit_similarity(Points::Constant(4, 2, 1.0), Points::Constant(4, 2, 3.0),
                                        Alignment::kSimilarity);
  EXPECT_EQ(map.scale, 1.0);
  EXPECT_EQ(map(Points::Constant(1, 2, 1.0)), Points::Constant(1, 2, 3.0));
  EXPECT_THROW(fit_similarity(Points(0, 2), Points(0, 2), Alignment::kRigid), InvalidInput);
}

TEST(PathAt, IsStraightBetweenPosesAndNowhereBeyond) {
  const Points at = positions_at(straight_path(4), Eigen::Vector4d(-0.1, 0.25, 3.0, 3.1));
  EXPECT_TRUE(std::isnan(at(0, 0)));
  EXPECT_EQ(at(1, 0), 0.25);
  EXPECT_EQ(at(2, 0), 3.0);
  EXPECT_TRUE(std::isnan(at(3, 0)));
}

TEST(TrajectoryError, AShiftIsItsErrorUnlessItIsAligned) {
  const Trajectory ground_truth = straight_path(101);
  Trajectory path = ground_truth;
  path.positions_m.rowwise() += Eigen::RowVector2d(3.0, 4.0);
  const auto error =
      trajectory_error(estimate_of(path), ground_truth, std::nullopt, Alignment::kNone);
  ASSERT_TRUE(error);
  EXPECT_NEAR(error->mean_m, 5.0, 1e-12);
  EXPECT_NEAR(error->rmse_m, 5.0, 1e-12);
  EXPECT_NEAR(error->best_tenth_m, 5.0, 1e-12);
  EXPECT_FALSE(error->landmarks_m);
  EXPECT_NEAR(
      trajectory_error(estimate_of(path), ground_truth, std::nullopt, Alignment::kRigid)->mean_m,
      0.0, 1e-12);
}

/// Off to the side by .01 t: a tenth of 100 s is eleven poses, the last one from 90 to 100.
TEST(TrajectoryError, TenthsAreTenthsOfTheTime) {
  const Trajectory ground_truth = straight_path(101);
  Trajectory path = ground_truth;
  path.positions_m.col(1) = 0.01 * ground_truth.time_s;
  const auto error =
      trajectory_error(estimate_of(path), ground_truth, std::nullopt, Alignment::kNone);
  EXPECT_NEAR(error->mean_m, 0.5, 1e-12);
  EXPECT_NEAR(error->last_tenth_m, 0.95, 1e-12);
  EXPECT_NEAR(error->best_tenth_m, 0.05, 1e-12);
  EXPECT_NEAR(error->worst_tenth_m, 0.95, 1e-12);
  EXPECT_EQ(error->poses, 101);
}

TEST(TrajectoryError, OnlyTheCommonTimeIsCompared) {
  const Trajectory ground_truth = straight_path(101);
  Trajectory path = straight_path(11);
  path.time_s.array() += 20.5;
  path.positions_m.col(0) = path.time_s;
  const auto error =
      trajectory_error(estimate_of(path), ground_truth, std::nullopt, Alignment::kNone);
  EXPECT_EQ(error->poses, 10);
  EXPECT_NEAR(error->mean_m, 0.0, 1e-12);
  path.time_s.array() += 1000.0;
  EXPECT_FALSE(trajectory_error(estimate_of(path), ground_truth, std::nullopt, Alignment::kNone));
}

TEST(TrajectoryError, LandmarksAreCarriedAlongWithThePath) {
  Random random(8);
  Trajectory ground_truth = straight_path(20);
  ground_truth.positions_m = random_points(20, random);
  const Similarity motion = random_similarity(random, 1.0, false);
  Points landmarks = random_points(4, random);
  SlamEstimate estimate = estimate_of(ground_truth);
  estimate.path.positions_m = motion(ground_truth.positions_m);
  estimate.landmarks_m = motion(landmarks);
  estimate.landmarks_m(2, 0) = std::nan("");
  landmarks.row(0) += Eigen::RowVector2d(0.3, 0.4);
  const auto error = trajectory_error(estimate, ground_truth, landmarks, Alignment::kRigid);
  EXPECT_NEAR(*error->landmarks_m, 0.5 / 3.0, 1e-11);
  EXPECT_THROW(trajectory_error(estimate, ground_truth, Points(2, 2), Alignment::kRigid),
               InvalidInput);
}

TEST(TrajectoryError, TimesThatDoNotAscendAreRefusedOfEitherPath) {
  const Trajectory path = straight_path(5);
  Trajectory doubled = path;
  doubled.time_s(2) = doubled.time_s(1);
  Trajectory standing = path;
  standing.time_s.setConstant(1.0);
  for (const Trajectory& broken : {doubled, standing}) {
    EXPECT_THROW(trajectory_error(estimate_of(path), broken, {}, Alignment::kNone), InvalidInput);
    EXPECT_THROW(trajectory_error(estimate_of(broken), path, {}, Alignment::kNone), InvalidInput);
  }
}

}  // namespace
}  // namespace mapproof
