#include "core/uncertainty/map_bootstrap.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "core/base/errors.hpp"
#include "tests/support/samples/drawn_points.hpp"

namespace mapproof {
namespace {

/// A map whose one landmark lies at the mean of a value of the steps.
MapOfSteps mean_of(const Eigen::MatrixXd& values) {
  return [values](const std::vector<Eigen::Index>& steps) -> std::optional<Points> {
    return Points(values(steps, Eigen::all).colwise().mean());
  };
}

TEST(BootstrapMap, EstimatesTheVarianceOfAMean) {
  Random random(3);
  Eigen::MatrixXd values(400, 2);
  for (Eigen::Index t = 0; t < 400; ++t) values.row(t) << random.normal(), 2.0 * random.normal();
  const MapUncertainty found = bootstrap_map(1, 400, mean_of(values), {.replicates = 4000});
  const Eigen::MatrixXd centred = values.rowwise() - values.colwise().mean();
  const Eigen::Matrix2d exact = centred.transpose() * centred / (400.0 * 400.0);
  EXPECT_LT((found.covariances[0] - exact).norm(), 0.1 * exact.norm());
  EXPECT_EQ(found.maps, 4000);
}

TEST(BootstrapMap, HasItsNominalCoverageForMeansOfCorrelatedSeries) {
  // 600 series of 500 steps whose mean has the variance (1 - rho^2) / (1 - rho)^2 / 500.
  int held = 0;
  constexpr int kSeries = 600;
  for (int s = 0; s < kSeries; ++s) {
    Random random(1000 + s);
    Eigen::MatrixXd values(500, 2);
    Eigen::RowVector2d x = test::normal_point(random);
    for (Eigen::Index t = 0; t < 500; ++t) {
      values.row(t) = x;
      x = 0.6 * x + 0.8 * test::normal_point(random);
    }
    const MapUncertainty found =
        bootstrap_map(1, 500, mean_of(values), {.replicates = 100, .block = 20});
    const Eigen::Vector2d off = values.colwise().mean().transpose();
    held += off.dot(found.covariances[0].ldlt().solve(off)) <= found.squared_radius;
  }
  EXPECT_NEAR(100.0 * held / kSeries, 95.0, 2.5);
}

TEST(BootstrapMap, IsTheSameForTheSameSeed) {
  const Eigen::MatrixXd values = Eigen::VectorXd::LinSpaced(50, 0.0, 1.0).replicate(1, 2);
  const auto once = bootstrap_map(1, 50, mean_of(values), {.block = 5, .seed = 7});
  EXPECT_EQ(once, bootstrap_map(1, 50, mean_of(values), {.block = 5, .seed = 7}));
  EXPECT_NE(once, bootstrap_map(1, 50, mean_of(values), {.block = 5, .seed = 8}));
}

TEST(BootstrapMap, HasNoCovarianceForALandmarkThatMostMapsMiss) {
  int call = 0;
  const MapOfSteps sometimes = [&](const std::vector<Eigen::Index>&) -> std::optional<Points> {
    Points map = Points::Constant(2, 2, 1.0 + 0.1 * call);
    if (++call % 3 != 0) map.row(1).setConstant(NAN);
    if (call % 10 == 0) return std::nullopt;
    return map;
  };
  const MapUncertainty found = bootstrap_map(2, 20, sometimes, {.replicates = 40});
  EXPECT_EQ(found.replicates, 40);
  EXPECT_EQ(found.maps, 36);
  EXPECT_TRUE(found.covariances[0].allFinite());
  EXPECT_TRUE(found.covariances[1].array().isNaN().all());
}

TEST(SquaredRadius, IsThatOfHotelling) {
  // 2 f / (f - 1) F(2, f - 1), by scipy.stats.f.ppf.
  EXPECT_NEAR(squared_radius(0.95, 10.0), 9.458877176, 1e-8);
  EXPECT_NEAR(squared_radius(0.99, 30.0), 11.214713876, 1e-8);
  EXPECT_NEAR(squared_radius(0.95, 1e9), 5.991464547, 1e-6);
  EXPECT_THROW(squared_radius(1.0, 10.0), InvalidInput);
  EXPECT_THROW(squared_radius(0.95, 1.0), InvalidInput);
}

TEST(ConfidenceEllipse, HasTheAxesOfItsCovariance) {
  MapUncertainty uncertainty;
  uncertainty.squared_radius = 4.0;
  Eigen::Matrix2d C;
  C << 2.5, 1.5, 1.5, 2.5;  // Variances 4 and 1 along the diagonals.
  uncertainty.covariances = {C, Eigen::Matrix2d::Constant(NAN)};
  const auto ellipse = confidence_ellipse(uncertainty, 0);
  ASSERT_TRUE(ellipse);
  EXPECT_NEAR(ellipse->a, 4.0, 1e-12);
  EXPECT_NEAR(ellipse->b, 2.0, 1e-12);
  EXPECT_NEAR(ellipse->rotation_rad, std::atan(1.0), 1e-12);
  EXPECT_FALSE(confidence_ellipse(uncertainty, 1));
}

}  // namespace
}  // namespace mapproof
