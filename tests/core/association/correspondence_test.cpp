#include "core/association/correspondence.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/model/experiment.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof::test {
namespace {

using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

ObservationHistory observed(Sensor sensor, int steps) {
  Random random(4);
  const World world = scatter_landmarks({.landmarks = 30}, random);
  const Path path = random_walk(world, {}, steps, random);
  return observe(world, path, {.sensor = sensor}, random);
}

/// Exchanges the measurements of doubtful landmarks of each step at random.
ObservationHistory shuffled(ObservationHistory history, const Mask& doubtful) {
  Random random(8);
  for (Eigen::Index step = 0; step < history.steps(); ++step) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index row = 0; row < history.landmarks(); ++row)
      if (doubtful(row, step)) rows.push_back(row);
    for (std::size_t k = rows.size(); k-- > 1;) {
      const auto other = static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1));
      std::swap(history.values(rows[k], step), history.values(rows[other], step));
    }
  }
  return history;
}

Mask doubted(Eigen::Index landmarks, Eigen::Index steps, double share) {
  Random random(6);
  Mask mask(landmarks, steps);
  for (Eigen::Index step = 0; step < steps; ++step)
    for (Eigen::Index row = 0; row < landmarks; ++row) mask(row, step) = random.uniform() < share;
  return mask;
}

double share_right(const ObservationHistory& found, const ObservationHistory& ground_truth,
                   const Mask& doubtful) {
  const auto right = (doubtful && (found.values.array() == ground_truth.values.array())).count();
  return static_cast<double>(right) / static_cast<double>(doubtful.count());
}

TEST(Assignment, IsTheBestOfAllPermutations) {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    Eigen::MatrixXd costs(5, 6);
    for (Eigen::Index k = 0; k < costs.size(); ++k) costs.data()[k] = random.uniform(-1.0, 1.0);
    const std::vector<Eigen::Index> found = least_assignment(costs);
    double sum = 0.0;
    for (Eigen::Index i = 0; i < 5; ++i) sum += costs(i, found[static_cast<std::size_t>(i)]);
    std::vector<Eigen::Index> columns(6);
    std::iota(columns.begin(), columns.end(), 0);
    double least = 1e9;
    do {
      double other = 0.0;
      for (Eigen::Index i = 0; i < 5; ++i) other += costs(i, columns[static_cast<std::size_t>(i)]);
      least = std::min(least, other);
    } while (std::ranges::next_permutation(columns).found);
    EXPECT_NEAR(sum, least, 1e-12);
  }
}

TEST(Assignment, RefusesMoreRowsThanColumns) {
  EXPECT_THROW(least_assignment(Eigen::MatrixXd::Zero(3, 2)), InvalidInput);
  EXPECT_TRUE(least_assignment(Eigen::MatrixXd(0, 0)).empty());
}

TEST(Correspondence, KeepsIdsThatAreRight) {
  const ObservationHistory ground_truth = observed(Sensor::kRange, 200);
  const Correspondence found =
      estimated_correspondence(ground_truth, Mask::Constant(30, 200, true), {.rank = 3});
  EXPECT_EQ(found.history.values, ground_truth.values);
  EXPECT_LT(found.loss_after, 1e-12);  // squared ranges are affine in the position
  EXPECT_TRUE(found.converged);
}

TEST(Correspondence, IsExactForRangesOfWhichAThirdHaveNoId) {
  const ObservationHistory ground_truth = observed(Sensor::kRange, 200);
  const Mask doubtful = doubted(30, 200, 0.33);
  const Correspondence found =
      estimated_correspondence(shuffled(ground_truth, doubtful), doubtful, {.rank = 3});
  EXPECT_EQ(share_right(found.history, ground_truth, doubtful), 1.0);
}

TEST(Correspondence, FindsMostIdsOfBearingsAndReducesTheLoss) {
  const ObservationHistory ground_truth = observed(Sensor::kBearing, 400);
  const Mask doubtful = doubted(30, 400, 0.3);
  const ObservationHistory confused = shuffled(ground_truth, doubtful);
  const Correspondence found = estimated_correspondence(confused, doubtful);
  EXPECT_LT(share_right(confused, ground_truth, doubtful), 0.2);
  EXPECT_GT(share_right(found.history, ground_truth, doubtful), 0.6);
  EXPECT_LT(found.loss_after, 0.5 * found.loss_before);
}

TEST(Correspondence, ExchangesMeasurementsOfOneStepOnly) {
  const ObservationHistory ground_truth = observed(Sensor::kBearing, 50);
  const Mask doubtful = doubted(30, 50, 0.5);
  const ObservationHistory confused = shuffled(ground_truth, doubtful);
  Eigen::MatrixXd found = estimated_correspondence(confused, doubtful).history.values;
  Eigen::MatrixXd given = confused.values;
  for (Eigen::Index step = 0; step < 50; ++step) {
    std::ranges::sort(found.col(step));
    std::ranges::sort(given.col(step));
  }
  EXPECT_EQ(found, given);
}

TEST(Correspondence, RefusesMissingEntries) {
  ObservationHistory history = observed(Sensor::kBearing, 5);
  EXPECT_THROW(estimated_correspondence(history, Mask::Constant(30, 4, true)), InvalidInput);
  history.values(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(estimated_correspondence(history, Mask::Constant(30, 5, true)), InvalidInput);
}

}  // namespace
}  // namespace mapproof::test
