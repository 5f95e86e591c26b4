#include "core/range_slam/known_landmarks.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <Eigen/SVD>

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "tests/core/range_slam/range_worlds.hpp"
#include "tests/support/samples/drawn_points.hpp"
#include "tests/support/slam_checks.hpp"

namespace mapproof {
namespace {

using test::has;
using test::points_about;
using test::ranges_between;
using test::spread_of;

SpectralMap map_of(const Points& landmarks, const Points& path,
                   const std::vector<Eigen::Index>& rows, double range_scale = 1.0) {
  const Eigen::MatrixXd Y = half_squared_ranges(range_scale * ranges_between(landmarks, path));
  return map_from_known_landmarks(factorize(Y, 4), {rows, landmarks(rows, Eigen::all)});
}

Points on_circle(Eigen::Index n, double radius_m, double center_m) {
  Points points(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * double(i * i) / double(n * n);
    points.row(i) << center_m + radius_m * std::cos(angle), radius_m * std::sin(angle);
  }
  return points;
}

RC_GTEST_PROP(KnownLandmarks, GiveBackAnyWorldWithoutNoise, (std::uint64_t seed)) {
  Random random(seed);
  const Eigen::RowVector2d center = test::uniform_point(random, -500.0, 500.0);
  const Points landmarks = points_about(*rc::gen::inRange(4, 12), random, 10.0, center);
  const Points path = points_about(*rc::gen::inRange(5, 300), random, 10.0, center);
  // A world that determines the map: neither four landmarks nor the path nearly on a line or
  // circle.
  RC_PRE(spread_of(landmarks.topRows(4)) < 1e3 && spread_of(path) < 1e3);
  const SpectralMap map = map_of(landmarks, path, {0, 1, 2, 3});
  RC_ASSERT(!map.empty() && map.statuses.empty());
  RC_ASSERT((landmarks_of(map.C) - landmarks).cwiseAbs().maxCoeff() < 1e-6);
  RC_ASSERT((positions_of(map.X) - path).cwiseAbs().maxCoeff() < 1e-6);
  RC_ASSERT(std::abs(map.range_scale - 1.0) < 1e-7);
}

TEST(KnownLandmarks, AllowForRangesThatAreTooLong) {
  Random random(2);
  const Points landmarks = points_about(6, random);
  const Points path = points_about(50, random);
  const SpectralMap map = map_of(landmarks, path, {1, 2, 4, 5}, 1.07);
  EXPECT_NEAR(map.range_scale, 1.07, 1e-11);
  EXPECT_LT((landmarks_of(map.C) - landmarks).norm(), 1e-9);
  EXPECT_LT((positions_of(map.X) - path).norm(), 1e-9);
}

TEST(KnownLandmarks, MoreThanFourShareTheMisfitOut) {
  Random random(3);
  const Points landmarks = points_about(8, random);
  const Points path = points_about(400, random);
  Eigen::MatrixXd ranges = ranges_between(landmarks, path);
  for (double& range : ranges.reshaped()) range += 0.05 * random.normal();
  const Factorization factors = factorize(half_squared_ranges(ranges, {.sigma_m = 0.05}), 4);
  const auto error = [&](const std::vector<Eigen::Index>& rows) {
    const SpectralMap map = map_from_known_landmarks(factors, {rows, landmarks(rows, Eigen::all)});
    return (positions_of(map.X) - path).norm();
  };
  EXPECT_LT(error({0, 1, 2, 3, 4, 5, 6, 7}), error({0, 1, 2, 3}));
}

TEST(KnownLandmarks, OnALineOrACircleAreDegenerateAndSaySo) {
  Random random(4);
  const Points path = points_about(60, random);
  Points line(5, 2);
  for (Eigen::Index i = 0; i < 5; ++i) line.row(i) << double(i * i), 2.0 * double(i * i) - 3.0;
  for (const Points& four : {line, on_circle(5, 7.0, 100.0)}) {
    const Points landmarks = test::stacked(four, points_about(4, random));
    const SpectralMap map = map_of(landmarks, path, {0, 1, 2, 3, 4});
    EXPECT_TRUE(map.empty());
    EXPECT_TRUE(has(map.statuses, StatusCode::kDegenerateGeometry));
    EXPECT_GT(*map.condition, 1e9);
  }
}

TEST(KnownLandmarks, InOnePlaceAreDegenerate) {
  Random random(5);
  const Points path = points_about(60, random);
  Points landmarks = points_about(6, random);
  landmarks.topRows(4).rowwise() = Eigen::RowVector2d(1.0, 2.0);
  EXPECT_TRUE(has(map_of(landmarks, path, {0, 1, 2, 3}).statuses, StatusCode::kDegenerateGeometry));
}

TEST(KnownLandmarks, BelowFourAreTooFew) {
  Random random(6);
  const Points landmarks = points_about(6, random);
  const SpectralMap map = map_of(landmarks, points_about(20, random), {0, 1, 2});
  EXPECT_TRUE(map.empty());
  EXPECT_TRUE(has(map.statuses, StatusCode::kTooFewObservations));
}

TEST(KnownLandmarks, OfAPathOnALineSayThatTheRankIsTooLow) {
  Random random(7);
  const Points landmarks = points_about(4, random);
  Points path = points_about(20, random);
  path.col(1).setConstant(3.0);
  EXPECT_TRUE(has(map_of(landmarks, path, {0, 1, 2, 3}).statuses, StatusCode::kRankDeficient));
}

TEST(KnownLandmarks, RefuseRowsThatAreTwiceOrNowhere) {
  Random random(8);
  const Points landmarks = points_about(5, random);
  const Points path = points_about(20, random);
  const Factorization factors = factorize(half_squared_ranges(ranges_between(landmarks, path)), 4);
  const Points four = landmarks.topRows(4);
  EXPECT_THROW(map_from_known_landmarks(factors, {{0, 1, 2, 2}, four}), InvalidInput);
  EXPECT_THROW(map_from_known_landmarks(factors, {{0, 1, 2, 5}, four}), InvalidInput);
  EXPECT_THROW(map_from_known_landmarks(factors, {{0, 1, 2}, four}), InvalidInput);
}

TEST(HalfSquaredRanges, AreFreeOfTheBiasOfNoise) {
  Random random(9);
  Eigen::MatrixXd ranges(1, 200000);
  for (double& range : ranges.reshaped())
    range = 20.0 * (1.0 + 0.1 * random.normal()) + 3.0 * random.normal();
  const double mean = half_squared_ranges(ranges, {.sigma_m = 3.0, .share = 0.1}).mean();
  EXPECT_NEAR(mean, 200.0, 0.5);  // six standard errors
  EXPECT_GT(half_squared_ranges(ranges).mean(), 205.0);
}

TEST(HalfSquaredRanges, RefuseWhatHasNoFiniteSquare) {
  EXPECT_THROW(half_squared_ranges(Eigen::MatrixXd::Constant(1, 1, 1e200)), InvalidInput);
  EXPECT_THROW(half_squared_ranges(Eigen::MatrixXd::Constant(1, 1, std::nan(""))), InvalidInput);
  EXPECT_THROW(half_squared_ranges(Eigen::MatrixXd::Ones(1, 1), {.sigma_m = -1.0}), InvalidInput);
}

TEST(Factorization, HasTheSingularValuesOfADenseSolver) {
  Random random(10);
  for (const auto& [rows, columns] : {std::pair{6, 40}, std::pair{12, 5}, std::pair{7, 7}}) {
    Eigen::MatrixXd Y(rows, columns);
    for (double& entry : Y.reshaped()) entry = random.normal();
    const Factorization factors = factorize(Y, 4);
    const Eigen::JacobiSVD<Eigen::MatrixXd> dense(Y, Eigen::ComputeThinU | Eigen::ComputeThinV);
    EXPECT_LT((factors.singular_values - dense.singularValues()).norm(), 1e-12);
    const Eigen::MatrixXd best = dense.matrixU().leftCols(4) *
                                 dense.singularValues().head(4).asDiagonal() *
                                 dense.matrixV().leftCols(4).transpose();
    EXPECT_LT((factors.U * factors.V - best).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace mapproof
