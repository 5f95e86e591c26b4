#include "render/figures/curves/thinning.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "tests/support/samples/drawn_points.hpp"

namespace mapproof::test {
namespace {

Trajectory path_of(const Points& points) {
  Trajectory path;
  path.time_s =
      Eigen::VectorXd::LinSpaced(points.rows(), 0.0, static_cast<double>(points.rows() - 1));
  path.positions_m = points;
  return path;
}

Trajectory wandering(int size) {
  Random random(3);
  Points points(size, 2);
  points.row(0).setZero();
  for (int i = 1; i < size; ++i) points.row(i) = points.row(i - 1) + normal_point(random);
  return path_of(points);
}

double distance_to_segment(const Eigen::RowVector2d& p, const Eigen::RowVector2d& a,
                           const Eigen::RowVector2d& b) {
  const double length2 = (b - a).squaredNorm();
  const double share = length2 > 0.0 ? std::clamp((p - a).dot(b - a) / length2, 0.0, 1.0) : 0.0;
  return (p - a - share * (b - a)).norm();
}

TEST(ThinPath, KeepsTheCornersOfASquareAlone) {
  Points points(41, 2);
  for (int i = 0; i <= 40; ++i) {
    const int side = std::min(i / 10, 3);
    const double along = 0.1 * (i - 10 * side);
    const Points corners = (Points(5, 2) << 0, 0, 1, 0, 1, 1, 0, 1, 0, 0).finished();
    points.row(i) = corners.row(side) + along * (corners.row(side + 1) - corners.row(side));
  }
  const ThinLine line = thin_path(path_of(points), 1e-9);
  EXPECT_EQ(line.x.size(), 5u);
  EXPECT_NEAR(line.y[2], 1.0, 1e-12);
}

TEST(ThinPath, LeavesNoPointFartherOffThanTheTolerance) {
  const Trajectory path = wandering(2000);
  for (const double tolerance : {0.1, 1.0, 5.0}) {
    const ThinLine line = thin_path(path, tolerance);
    EXPECT_LT(line.x.size(), 2000u);
    std::size_t piece = 0;
    for (Eigen::Index i = 0; i < path.size(); ++i) {
      const Eigen::RowVector2d at = path.positions_m.row(i);
      const auto point = [&](std::size_t k) { return Eigen::RowVector2d(line.x[k], line.y[k]); };
      if (piece + 2 < line.x.size() && at == point(piece + 1)) ++piece;
      EXPECT_LE(distance_to_segment(at, point(piece), point(piece + 1)), tolerance + 1e-9) << i;
    }
  }
}

TEST(ThinPath, WithoutToleranceKeepsEveryCorner) {
  const Trajectory path = wandering(300);
  EXPECT_EQ(thin_path(path, 0.0).x.size(), 300u);
}

TEST(ThinPath, BreaksAtPlacesThatAreNoneAndAtLongPauses) {
  Points points = Points::Zero(30, 2);
  points.col(0) = Eigen::VectorXd::LinSpaced(30, 0.0, 29.0);
  Trajectory path = path_of(points);
  path.positions_m.row(10).setConstant(NAN);
  path.positions_m(11, 1) = INFINITY;
  path.time_s.tail(10).array() += 50.0;
  const ThinLine line = thin_path(path, 0.01);
  ASSERT_EQ(line.x.size(), 8u);  // Three pieces of two ends, two breaks.
  EXPECT_TRUE(std::isnan(line.x[2]) && std::isnan(line.y[2]));
  EXPECT_EQ(line.x[1], 9.0);
  EXPECT_EQ(line.x[3], 12.0);
  EXPECT_EQ(line.x[4], 19.0);
  EXPECT_EQ(line.x[6], 20.0);
}

TEST(ThinPath, OfNothingAndOfOnePointIsThat) {
  EXPECT_TRUE(thin_path({}, 1.0).x.empty());
  EXPECT_EQ(thin_path(path_of(Points::Ones(1, 2)), 1.0).x.size(), 1u);
  EXPECT_THROW(thin_path(path_of(Points::Ones(1, 2)), -1.0), InvalidInput);
}

TEST(ThinCurve, KeepsEveryPeakAndTheEndsOfEachPiece) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(10000, 0.0, 999.9);
  std::vector<double> values(10000, 1.0);
  values[1234] = 9.0;
  values[7777] = -3.0;
  const ThinLine line = thin_curve(time, values, 50);
  EXPECT_LE(line.x.size(), 200u);
  EXPECT_EQ(line.x.front(), 0.0);
  EXPECT_EQ(line.x.back(), 999.9);
  EXPECT_NE(std::ranges::find(line.y, 9.0), line.y.end());
  EXPECT_NE(std::ranges::find(line.y, -3.0), line.y.end());
  EXPECT_TRUE(std::ranges::is_sorted(line.x));
}

TEST(ThinCurve, BreaksAtValuesThatAreNoNumbers) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(6, 0.0, 5.0);
  const ThinLine line = thin_curve(time, {1.0, 2.0, NAN, INFINITY, 3.0, NAN}, 100);
  ASSERT_EQ(line.x.size(), 5u);
  EXPECT_TRUE(std::isnan(line.y[2]));
  EXPECT_EQ(line.y[3], 3.0);
  EXPECT_THROW(thin_curve(time, {1.0}, 10), InvalidInput);
  EXPECT_THROW(thin_curve(time, std::vector<double>(6), 0), InvalidInput);
}

TEST(MedianCurve, IsTheMedianOfEachPieceOfTime) {
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(1001, 0.0, 100.0);
  std::vector<double> values;
  for (int i = 0; i < 1001; ++i) values.push_back(i % 3 == 0 ? 100.0 : 1.0 + 0.001 * i);
  const ThinLine line = median_curve(time, values, 10);
  ASSERT_EQ(line.x.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_NEAR(line.x[i], 10.0 * double(i) + 5.0, 0.1);
    EXPECT_NEAR(line.y[i], 1.0 + 0.1 * double(i) + 0.075, 0.01) << "Two thirds are on the slope.";
  }
  values[500] = NAN;  // Between two pieces: breaks the line.
  EXPECT_EQ(median_curve(time, values, 10).x.size(), 11U);
  EXPECT_EQ(median_curve(time.head(3), {1.0, 5.0, 2.0}, 10).y, (std::vector{1.0, 5.0, 2.0}));
  EXPECT_THROW(median_curve(time, {1.0}, 10), InvalidInput);
}

}  // namespace
}  // namespace mapproof::test
