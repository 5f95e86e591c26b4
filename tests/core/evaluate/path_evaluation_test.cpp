#include "core/evaluate/path_evaluation.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"

namespace mapproof {
namespace {

constexpr double kPi = std::numbers::pi;

/// Along x at 1 m/s, one pose per second, heading along x.
SpacePath straight_line(Eigen::Index poses, double step_m = 1.0) {
  SpacePath path{.time_s = Eigen::VectorXd::LinSpaced(poses, 0.0, static_cast<double>(poses - 1)),
                 .positions_m = SpacePoints::Zero(poses, 3),
                 .orientations = {}};
  path.positions_m.col(0) = step_m * path.time_s;
  path.orientations.assign(static_cast<std::size_t>(poses), Eigen::Matrix3d::Identity());
  return path;
}

/// Around a circle, heading along it; `poses` steps of one second make it whole.
SpacePath circle(Eigen::Index poses, double radius_m) {
  SpacePath path = straight_line(poses + 1);
  for (Eigen::Index i = 0; i <= poses; ++i) {
    const double angle = 2.0 * kPi * static_cast<double>(i) / static_cast<double>(poses);
    path.positions_m.row(i) << radius_m * std::cos(angle), radius_m * std::sin(angle), 0.0;
    path.orientations[static_cast<std::size_t>(i)] =
        Eigen::AngleAxisd(angle + 0.5 * kPi, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }
  return path;
}

SpacePath moved(SpacePath path, const SpaceSimilarity& map) {
  path.positions_m = map(path.positions_m);
  for (Eigen::Matrix3d& R : path.orientations) R = map.rotation * R;
  return path;
}

SpaceSimilarity some_motion(double scale = 1.0) {
  return {
      .scale = scale,
      .rotation =
          Eigen::AngleAxisd(2.2, Eigen::Vector3d(1.0, -2.0, 0.5).normalized()).toRotationMatrix(),
      .offset = {30.0, -7.0, 4.0}};
}

/// A path that uses all of space.
SpacePath random_path(Eigen::Index poses, std::uint64_t seed) {
  Random random(seed);
  SpacePath path = straight_line(poses);
  for (Eigen::Index i = 0; i < poses; ++i) {
    path.positions_m.row(i) << random.normal(), random.normal(), random.normal();
    path.orientations[static_cast<std::size_t>(i)] =
        Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal())
            .normalized()
            .toRotationMatrix();
  }
  return path;
}

ErrorStatistics ate(const SpacePath& ground_truth, const SpacePath& estimate,
                    FrameAlignment alignment) {
  return error_statistics(
      evaluate_path(ground_truth, estimate, {.alignment = alignment}).poses.error_m);
}

TEST(PathEvaluation, AStretchedLineHasAnErrorThatGrowsWithTheWay) {
  // 1 % too long: |error| = 0.01 i of pose i = 0 ... n - 1, without alignment.
  const Eigen::Index n = 101;
  const PathEvaluation result =
      evaluate_path(straight_line(n), straight_line(n, 1.01),
                    {.alignment = FrameAlignment::kNone, .spacings = {{10.0, PairUnit::kPoses}}});
  const ErrorStatistics errors = error_statistics(result.poses.error_m);
  EXPECT_NEAR(errors.mean, 0.5, 1e-12);
  EXPECT_NEAR(errors.median, 0.5, 1e-12);
  EXPECT_NEAR(errors.maximum, 1.0, 1e-12);
  EXPECT_NEAR(errors.rmse, 0.01 * std::sqrt(100.0 * 201.0 / 6.0), 1e-12);
  ASSERT_EQ(result.relative.size(), 1U);
  EXPECT_EQ(result.relative[0].error_m.size(), 10);
  EXPECT_NEAR(result.relative[0].error_m.maxCoeff(), 0.1, 1e-12);
  EXPECT_NEAR(result.relative[0].error_m.minCoeff(), 0.1, 1e-12);
  EXPECT_NEAR(result.relative[0].percent.mean(), 1.0, 1e-12);
  EXPECT_NEAR(result.relative[0].error_deg.maxCoeff(), 0.0, 1e-12);
}

TEST(PathEvaluation, ARigidAlignmentCentresAStretchedLine) {
  // Errors of 0.01 |i - 50|: the mean square is 0.0001 (n^2 - 1) / 12 with n = 101.
  const ErrorStatistics errors =
      ate(straight_line(101), straight_line(101, 1.01), FrameAlignment::kRigid);
  EXPECT_NEAR(errors.rmse, 0.01 * std::sqrt((101.0 * 101.0 - 1.0) / 12.0), 1e-12);
  EXPECT_NEAR(ate(straight_line(101), straight_line(101, 1.01), FrameAlignment::kSimilarity).rmse,
              0.0, 1e-12);
}

TEST(PathEvaluation, ACircleThatIsTooLargeKeepsTheDifferenceOfRadii) {
  // The last pose is the first one again, so a tenth of the circle has no centre of mass at 0.
  SpacePath ground_truth = circle(36, 10.0), estimate = circle(36, 10.5);
  EXPECT_NEAR(ate(ground_truth, estimate, FrameAlignment::kNone).rmse, 0.5, 1e-12);
  EXPECT_NEAR(ate(ground_truth, estimate, FrameAlignment::kNone).maximum, 0.5, 1e-12);
  // The first poses coincide: a pose at the angle a is then 0.5 |e^ia - 1| = sin(a / 2) away.
  EXPECT_NEAR(ate(ground_truth, estimate, FrameAlignment::kFirstPose).maximum, 1.0, 1e-12);
  EXPECT_NEAR(ate(ground_truth, estimate, FrameAlignment::kSimilarity).rmse, 0.0, 1e-12);
}

TEST(PathEvaluation, AYawDriftIsTheRotationOfEveryPair) {
  // The estimate yaws 0.1 degrees more per second.
  SpacePath ground_truth = straight_line(61), estimate = straight_line(61);
  for (std::size_t i = 0; i < estimate.orientations.size(); ++i)
    estimate.orientations[i] =
        Eigen::AngleAxisd(0.1 * static_cast<double>(i) * kPi / 180.0, Eigen::Vector3d::UnitZ())
            .toRotationMatrix();
  const PathEvaluation result =
      evaluate_path(ground_truth, estimate,
                    {.alignment = FrameAlignment::kNone, .spacings = {{5.0, PairUnit::kSeconds}}});
  EXPECT_NEAR(result.poses.error_deg(60), 6.0, 1e-10);
  ASSERT_EQ(result.relative.size(), 1U);
  EXPECT_EQ(result.relative[0].error_deg.size(), 12);
  for (const double error_deg : result.relative[0].error_deg) EXPECT_NEAR(error_deg, 0.5, 1e-10);
}

TEST(PathEvaluation, MotionsAndScalesAreUndone) {
  const SpacePath ground_truth = random_path(50, 3);
  EXPECT_LT(ate(ground_truth, moved(ground_truth, some_motion()), FrameAlignment::kRigid).maximum,
            1e-12);
  EXPECT_LT(
      ate(ground_truth, moved(ground_truth, some_motion()), FrameAlignment::kFirstPose).maximum,
      1e-11);
  EXPECT_LT(
      ate(ground_truth, moved(ground_truth, some_motion(0.3)), FrameAlignment::kSimilarity).maximum,
      1e-12);
}

TEST(PathEvaluation, RelativeErrorsDoNotDependOnAMotionOfEither) {
  const SpacePath ground_truth = random_path(40, 5), estimate = random_path(40, 6);
  const PathEvaluationOptions options{.alignment = FrameAlignment::kNone,
                                      .spacings = {{2.0, PairUnit::kMetres}}};
  const RelativeErrors plain = evaluate_path(ground_truth, estimate, options).relative.at(0);
  const RelativeErrors after =
      evaluate_path(moved(ground_truth, some_motion()), estimate, options).relative.at(0);
  EXPECT_LT((plain.error_m - after.error_m).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((plain.error_deg - after.error_deg).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PathEvaluation, TheBestAlignmentIsNoWorseThanManyOthers) {
  const SpacePath ground_truth = random_path(30, 8);
  const SpacePath estimate = random_path(30, 9);
  const double best = ate(ground_truth, estimate, FrameAlignment::kRigid).rmse;
  Random random(10);
  for (int i = 0; i < 200; ++i) {
    const SpaceSimilarity other{.rotation = Eigen::Quaterniond(random.normal(), random.normal(),
                                                               random.normal(), random.normal())
                                                .normalized()
                                                .toRotationMatrix(),
                                .offset = ground_truth.positions_m.colwise().mean()};
    EXPECT_LE(best, ate(ground_truth, moved(estimate, other), FrameAlignment::kNone).rmse);
  }
}

/// Every pair within a tenth of the length, by a search through all.
std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs_by_search(const Eigen::VectorXd& along,
                                                                   double length) {
  std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
  for (Eigen::Index i = 0; i + 1 < along.size(); ++i) {
    Eigen::Index best = i + 1;
    for (Eigen::Index k = i + 2; k < along.size(); ++k)
      if (std::abs(along(k) - along(i) - length) < std::abs(along(best) - along(i) - length))
        best = k;
    if (std::abs(along(best) - along(i) - length) <= 0.1 * length) pairs.emplace_back(i, best);
  }
  return pairs;
}

TEST(PathEvaluation, AllPairsAreThoseOfASearchThroughAll) {
  const Eigen::Index n = 60;
  SpacePath ground_truth = straight_line(n), estimate = straight_line(n);
  Random random(11);
  for (Eigen::Index i = 1; i < n; ++i) {  // Some poses stand still.
    const double step_m = random.uniform() < 0.2 ? 0.0 : random.uniform();
    estimate.positions_m(i, 0) = estimate.positions_m(i - 1, 0) + step_m;
    estimate.time_s(i) = ground_truth.time_s(i) = estimate.time_s(i - 1) + random.uniform();
  }
  for (const PairSpacing spacing :
       {PairSpacing{2.0, PairUnit::kMetres}, PairSpacing{2.0, PairUnit::kSeconds}}) {
    const Eigen::VectorXd along =
        spacing.unit == PairUnit::kMetres ? estimate.positions_m.col(0) : estimate.time_s;
    const auto pairs = pairs_by_search(along, spacing.length);
    const PathEvaluation result = evaluate_path(
        ground_truth, estimate,
        {.alignment = FrameAlignment::kNone, .spacings = {spacing}, .pairs = PairChoice::kAll});
    ASSERT_EQ(result.relative.at(0).error_m.size(), std::ssize(pairs));
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [i, j] = pairs[k];
      const double way_m = estimate.positions_m(j, 0) - estimate.positions_m(i, 0);
      EXPECT_NEAR(result.relative[0].error_m(static_cast<Eigen::Index>(k)),
                  std::abs(way_m - static_cast<double>(j - i)), 1e-12);
    }
  }
}

TEST(PathEvaluation, AllPairsOfPosesBeginAtEveryPose) {
  const PathEvaluation result =
      evaluate_path(straight_line(30), straight_line(30, 1.5),
                    {.alignment = FrameAlignment::kNone,
                     .spacings = {{7.0, PairUnit::kPoses}, {30.0, PairUnit::kPoses}},
                     .pairs = PairChoice::kAll});
  ASSERT_EQ(result.relative.size(), 1U);
  ASSERT_EQ(result.relative[0].error_m.size(), 23);
  EXPECT_NEAR(result.relative[0].error_m.maxCoeff(), 3.5, 1e-12);
  EXPECT_NEAR(result.relative[0].error_m.minCoeff(), 3.5, 1e-12);
}

/// A line whose poses are off by these metres in each axis and turned by these angles.
SpacePath shifted_line(const Eigen::RowVector3d& by_m, double yaw) {
  SpacePath path = straight_line(20);
  path.positions_m.rowwise() += by_m;
  for (Eigen::Matrix3d& R : path.orientations)
    R = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  return path;
}

TEST(PathEvaluation, InAPlaneTheThirdAxisDoesNotCount) {
  const SpacePath estimate = shifted_line({3.0, 4.0, 12.0}, 0.5);
  const auto error_m = [&](std::optional<Plane> plane) {
    return evaluate_path(straight_line(20), estimate,
                         {.alignment = FrameAlignment::kNone, .plane = plane});
  };
  EXPECT_NEAR(error_m(std::nullopt).poses.error_m(7), 13.0, 1e-12);
  EXPECT_NEAR(error_m(Plane::kXy).poses.error_m(7), 5.0, 1e-12);
  EXPECT_NEAR(error_m(Plane::kXz).poses.error_m(7), std::hypot(3.0, 12.0), 1e-12);
  EXPECT_NEAR(error_m(Plane::kYz).poses.error_m(7), std::hypot(4.0, 12.0), 1e-12);
  EXPECT_NEAR(error_m(Plane::kXy).poses.error_deg(7), 0.5 * 180.0 / kPi, 1e-10);
  EXPECT_NEAR(error_m(Plane::kXz).poses.error_deg(7), 0.0, 1e-10);
}

TEST(PathEvaluation, AProjectedPathStaysAsItIs) {
  const SpacePath path = random_path(20, 3);
  for (const Plane plane : {Plane::kXy, Plane::kXz, Plane::kYz}) {
    const SpacePath once = projected(path, plane), twice = projected(once, plane);
    EXPECT_EQ(once.positions_m, twice.positions_m);
    for (std::size_t i = 0; i < once.orientations.size(); ++i)
      EXPECT_LT((once.orientations[i] - twice.orientations[i]).norm(), 1e-12);
    EXPECT_EQ(plane_named(name(plane)), plane);
  }
  EXPECT_EQ(plane_named("zx"), std::nullopt);
}

TEST(PathEvaluation, KeepsWhereTheGroundTruthIsAlone) {
  const SpacePath ground_truth = straight_line(5000);
  SpacePath estimate = straight_line(200);
  estimate.time_s.tail(100).array() += 1000.0;
  const PoseErrors poses = evaluate_path(ground_truth, estimate, {}).poses;
  EXPECT_EQ(poses.size(), 200);
  const LonePoses& alone = poses.ground_truth_alone;
  ASSERT_GT(alone.time_s.size(), 900);
  EXPECT_LE(alone.time_s.size(), 1000);
  EXPECT_EQ(alone.time_s(0), 100.0);
  EXPECT_EQ(alone.positions_m.col(0), alone.time_s);
  EXPECT_EQ(poses.estimate_alone.time_s.size(), 0);
  const PoseErrors other = evaluate_path(estimate, ground_truth, {}).poses;
  EXPECT_EQ(other.ground_truth_alone.time_s.size(), 0);
  EXPECT_EQ(other.estimate_alone.time_s, alone.time_s);
}

TEST(PathEvaluation, PathsWithoutTimesNeedAsManyPoses) {
  SpacePath ground_truth = straight_line(5), estimate = straight_line(6);
  ground_truth.has_times = false;
  EXPECT_THROW(evaluate_path(ground_truth, estimate, {}), InvalidInput);
  EXPECT_EQ(evaluate_path(ground_truth, straight_line(5, 2.0), {}).poses.size(), 5);
}

TEST(PathEvaluation, TooFewAssociatedPosesAreRefused) {
  SpacePath estimate = straight_line(20);
  estimate.time_s.array() += 0.4;
  EXPECT_THROW(evaluate_path(straight_line(20), estimate, {}), InvalidInput);
  EXPECT_EQ(evaluate_path(straight_line(20), estimate,
                          {.association = {.offset_s = -0.4, .largest_gap_s = 1e-9}})
                .poses.size(),
            20);
}

TEST(TimeAssociation, IsThatOfASearchThroughAll) {
  Random random(4);
  for (int round = 0; round < 50; ++round) {
    Eigen::VectorXd a(30), b(30 + round % 3);
    for (Eigen::VectorXd* times : {&a, &b}) {
      for (double& time : *times) time = std::floor(random.uniform(0.0, 40.0)) / 4.0;
      std::sort(times->begin(), times->end());
    }
    const TimeAssociation options{.offset_s = 0.125, .largest_gap_s = 0.3};
    std::vector<PosePair> expected;
    const bool b_is_longer = b.size() > a.size();
    const Eigen::VectorXd few = b_is_longer ? a : b;
    const Eigen::VectorXd many = b_is_longer ? Eigen::VectorXd(b.array() + options.offset_s)
                                             : Eigen::VectorXd(a.array() - options.offset_s);
    for (Eigen::Index i = 0; i < few.size(); ++i) {
      Eigen::Index k = 0;
      const double gap = (many.array() - few(i)).abs().minCoeff(&k);
      if (gap <= options.largest_gap_s)
        expected.push_back(b_is_longer ? PosePair{i, k} : PosePair{k, i});
    }
    EXPECT_EQ(associate_times(a, b, options), expected);
  }
}

TEST(Spacings, AreOneTwoAndFiveOfEachDecade) {
  std::vector<double> lengths;
  for (const PairSpacing& spacing : usual_spacings(500.0)) lengths.push_back(spacing.length);
  EXPECT_EQ(lengths, (std::vector<double>{5.0, 10.0, 20.0, 50.0, 100.0}));
}

}  // namespace
}  // namespace mapproof
