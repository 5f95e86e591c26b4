#include "core/range_slam/factors/spectral_slam.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/range_slam/log_checks.hpp"

namespace mapproof {
namespace {

Points scattered(Eigen::Index count, std::uint64_t seed) {
  Random random(seed);
  return Points::NullaryExpr(
      count, 2, [&](Eigen::Index, Eigen::Index) { return 40.0 * random.uniform() - 10.0; });
}

Eigen::MatrixXd half_squares(const Points& landmarks, const Points& path, double scale) {
  Eigen::MatrixXd Y(landmarks.rows(), path.rows());
  for (Eigen::Index n = 0; n < Y.rows(); ++n)
    for (Eigen::Index t = 0; t < Y.cols(); ++t)
      Y(n, t) = 0.5 * scale * scale * (landmarks.row(n) - path.row(t)).squaredNorm();
  return Y;
}

TEST(LandmarksOnPath, AreExactWithoutNoiseWhateverTheScaleOfTheRanges) {
  const Points landmarks = scattered(5, 1), path = scattered(60, 2);
  for (const double scale : {1.0, 1.07, 0.5}) {
    const LandmarksOnPath observed = landmarks_on_path(path, half_squares(landmarks, path, scale));
    EXPECT_LT((observed.landmarks_m - landmarks).norm(), 1e-10 * landmarks.norm());
    EXPECT_NEAR(observed.range_scale, scale, 1e-12);
  }
}

TEST(LandmarksOnPath, TakeTheRangesAsTheyAreWhereThePathIsACircle) {
  Points circle(40, 2);
  for (Eigen::Index t = 0; t < 40; ++t)
    circle.row(t) << 7.0 + 3.0 * std::cos(0.2 * double(t)), 1.0 + 3.0 * std::sin(0.2 * double(t));
  const Points landmarks = scattered(4, 3);
  const LandmarksOnPath observed = landmarks_on_path(circle, half_squares(landmarks, circle, 1.0));
  EXPECT_EQ(observed.range_scale, 1.0);
  EXPECT_LT((observed.landmarks_m - landmarks).norm(), 1e-9 * landmarks.norm());
}

TEST(NearlyALine, IsSaidWithItsConditionNumber) {
  Points points(3, 2);
  points << 0, 0, 10, 0.1, 20, 0;
  const auto landmarks = landmarks_on_a_line(points);
  ASSERT_TRUE(landmarks);
  EXPECT_EQ(landmarks->code, StatusCode::kDegenerateGeometry);
  EXPECT_NEAR(landmarks->values[0], 173.0, 0.5);
  EXPECT_EQ(path_on_a_line(points)->code, StatusCode::kUndetermined);
  points(1, 1) = 5.0;
  EXPECT_FALSE(landmarks_on_a_line(points));
  points(1, 1) = NAN;
  EXPECT_FALSE(path_on_a_line(points));
}

TEST(LandmarksOnPath, RefuseALineAndOtherSizes) {
  Points line = Points::Zero(10, 2);
  line.col(0).setLinSpaced(0.0, 9.0);
  EXPECT_THROW(landmarks_on_path(line, Eigen::MatrixXd::Ones(4, 10)), InvalidInput);
  EXPECT_THROW(landmarks_on_path(scattered(9, 1), Eigen::MatrixXd::Ones(4, 10)), InvalidInput);
}

}  // namespace
}  // namespace mapproof
