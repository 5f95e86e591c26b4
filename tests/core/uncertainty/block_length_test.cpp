#include "core/uncertainty/block_length.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"

namespace mapproof {
namespace {

/// x_t = rho x_{t-1} + normal noise.
Eigen::VectorXd autoregressive(Eigen::Index n, double rho, std::uint64_t seed) {
  Random random(seed);
  Eigen::VectorXd series(n);
  double x = random.normal() / std::sqrt(1.0 - rho * rho);
  for (Eigen::Index t = 0; t < n; ++t) {
    series(t) = x;
    x = rho * x + random.normal();
  }
  return series;
}

/// The length of least error for that series, in closed form: G = sum |k| R(k) and g = sum R(k) of
/// R(k) ~ rho^|k| give (2 G^2 / (4/3 g^2))^(1/3) n^(1/3) = (6 rho^2 / (1 - rho^2)^2)^(1/3) n^(1/3).
double best_of_autoregressive(double n, double rho) {
  return std::cbrt(6.0 * rho * rho / ((1.0 - rho * rho) * (1.0 - rho * rho)) * n);
}

TEST(BestBlockLength, IsThatOfTheClosedFormForAutoregressiveSeries) {
  for (const double rho : {0.5, 0.8, 0.9}) {
    double mean = 0.0;
    constexpr int kSeries = 20;
    for (int i = 0; i < kSeries; ++i)
      mean += best_block_length(autoregressive(20000, rho, 100 + i)) / kSeries;
    const double best = best_of_autoregressive(20000.0, rho);
    EXPECT_NEAR(mean, best, 0.2 * best) << rho;
  }
}

TEST(BestBlockLength, IsShortForIndependentValues) {
  EXPECT_LE(best_block_length(autoregressive(5000, 0.0, 3)), 6.0);
}

TEST(BestBlockLength, IsOneWithoutVarianceOrLength) {
  EXPECT_EQ(best_block_length(Eigen::VectorXd::Constant(100, 3.5)), 1.0);
  EXPECT_EQ(best_block_length(Eigen::VectorXd::LinSpaced(5, 0.0, 1.0)), 1.0);
  EXPECT_EQ(best_block_length({}), 1.0);
}

TEST(BestBlockLength, StaysWithinItsBoundForATrend) {
  const double length = best_block_length(Eigen::VectorXd::LinSpaced(400, 0.0, 1.0));
  EXPECT_GT(length, 10.0);
  EXPECT_LE(length, 60.0);
}

TEST(BestBlockLength, DoesNotDependOnScaleOrOffset) {
  const Eigen::VectorXd series = autoregressive(3000, 0.7, 5);
  const Eigen::VectorXd moved = (1e3 * series.array() + 7.0).matrix();
  EXPECT_NEAR(best_block_length(series), best_block_length(moved), 1e-6);
}

TEST(MapBlockLength, LeavesRoomForThreeBlocks) {
  ObservationHistory history{Sensor::kBearing, {"a", "b", "c"}, Eigen::MatrixXd(3, 30)};
  for (Eigen::Index t = 0; t < 30; ++t) history.values.col(t) << 0.0, 0.1 * double(t), 1.0;
  EXPECT_LE(map_block_length(history, 30), 10);
  EXPECT_GE(map_block_length(history, 30), 1);
  EXPECT_THROW(map_block_length(history, 31), InvalidInput);
}

TEST(MapBlockLength, AcceptsHistoriesWithoutAnyCommonStep) {
  ObservationHistory history{Sensor::kRange, {"a", "b"}, Eigen::MatrixXd(2, 12)};
  history.values.setConstant(NAN);
  for (Eigen::Index t = 0; t < 12; ++t) history.values(t % 2, t) = double(t);
  EXPECT_EQ(map_block_length(history, 12), 1);
}

}  // namespace
}  // namespace mapproof
