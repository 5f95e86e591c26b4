#include "core/mixed/mixed_distances.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

ObservationHistory bearings(double noise_rad) {
  Random random(4);
  const World world = scatter_landmarks({.side_m = 1.5, .landmarks = 20}, random);
  const Path path = random_walk(world, {}, 400, random);
  return observe(world, path, {.sensor = Sensor::kBearing, .noise = noise_rad}, random);
}

TEST(Reliability, FallsWithNoise) {
  const double clean = reliability(bearings(0.0), 400);
  const double noisy = reliability(bearings(1.5), 400);
  EXPECT_GT(clean, 0.8);
  EXPECT_LT(noisy, 0.9 * clean);
  EXPECT_GE(noisy, 0.0);
}

TEST(Reliability, IsZeroWithoutObservations) {
  ObservationHistory nothing{Sensor::kRange, {"a", "b", "c"}, {}};
  nothing.values.setConstant(3, 10, NAN);
  EXPECT_EQ(reliability(nothing, 10), 0.0);
  EXPECT_EQ(reliability(bearings(0.0), 3), 0.0);
  EXPECT_THROW(reliability(nothing, 11), InvalidInput);
}

TEST(WeightsOf, AreSignalOverNoise) {
  const std::vector<double> weights = weights_of({0.5, 0.75});
  EXPECT_DOUBLE_EQ(weights[0], 0.25);
  EXPECT_DOUBLE_EQ(weights[1], 0.75);
  EXPECT_EQ(weights_of({0.0, 0.0}), (std::vector<double>{0.5, 0.5}));
}

TEST(MixedProximities, OfOneSensorAreItsOwnUpToScale) {
  const Eigen::MatrixXd D = test::distances_of(test::scattered(8, 1)).cwiseAbs2();
  const Proximities mixed = mixed_proximities({D, 7.0 * D}, {1.0, 3.0});
  const double scale = mixed.squared_distances(0, 1) / D(0, 1);
  EXPECT_LT((mixed.squared_distances - scale * D).norm(), 1e-12 * mixed.squared_distances.norm());
  for (Eigen::Index j = 0; j < 8; ++j)
    for (Eigen::Index i = 0; i < 8; ++i)
      EXPECT_NEAR(mixed.inner_products(i, i) + mixed.inner_products(j, j) -
                      2.0 * mixed.inner_products(i, j),
                  mixed.squared_distances(i, j), 1e-12);
}

TEST(MixedProximities, TakeAPairFromTheSensorThatHasIt) {
  Eigen::MatrixXd one = Eigen::MatrixXd::Ones(3, 3), other = Eigen::MatrixXd::Ones(3, 3);
  one.diagonal().setZero();
  other.diagonal().setZero();
  one(0, 1) = one(1, 0) = HUGE_VAL;
  EXPECT_EQ(mixed_proximities({one, other}, {1.0, 1.0}).squared_distances(0, 1), 1.0);
  EXPECT_TRUE(std::isinf(mixed_proximities({one, other}, {1.0, 0.0}).squared_distances(0, 1)));
  EXPECT_THROW(mixed_proximities({one}, {0.0}), InvalidInput);
  EXPECT_THROW(mixed_proximities({one, Eigen::MatrixXd::Ones(2, 2)}, {1.0, 1.0}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
