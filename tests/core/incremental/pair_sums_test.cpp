#include "core/incremental/incremental_map.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"

namespace mapproof {
namespace {

/// A history of random values, a share of them missing, and a landmark that arrives late.
ObservationHistory random_history(Sensor sensor, double missing, std::uint64_t seed) {
  Random random(seed);
  ObservationHistory history{sensor, {"a", "b", "c", "d", "e", "f"}, Eigen::MatrixXd(6, 40)};
  for (Eigen::Index t = 0; t < 40; ++t)
    for (Eigen::Index i = 0; i < 6; ++i) {
      double value = random.uniform(0.0, 3.0);
      if (sensor == Sensor::kVisibility) value = value < 1.0 ? 1.0 : 0.0;
      const bool gone = random.uniform() < missing || (i == 5 && t < 20 && missing > 0.0);
      history.values(i, t) = gone ? std::numeric_limits<double>::quiet_NaN() : value;
    }
  return history;
}

std::vector<StepEntry> column_at(const ObservationHistory& history, Eigen::Index t) {
  std::vector<StepEntry> step;
  for (Eigen::Index i = 0; i < history.landmarks(); ++i)
    if (!std::isnan(history.values(i, t))) step.push_back({i, history.values(i, t)});
  return step;
}

void expect_equal(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  ASSERT_EQ(found.rows(), expected.rows());
  for (Eigen::Index i = 0; i < found.size(); ++i)
    if (std::isinf(expected(i))) {
      EXPECT_EQ(found(i), expected(i));
    } else {
      EXPECT_NEAR(found(i), expected(i), 1e-9 * std::max(1.0, std::abs(expected(i))));
    }
}

class SumsOfEverySensor : public ::testing::TestWithParam<std::pair<Sensor, double>> {};

TEST_P(SumsOfEverySensor, GiveTheProximitiesOfTheHistoryAfterEveryStep) {
  const auto [sensor, missing] = GetParam();
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const ObservationHistory history = random_history(sensor, missing, seed);
    PairSums sums(sensor);
    sums.grow(6);
    for (Eigen::Index t = 0; t < history.steps(); ++t) {
      sums.add(column_at(history, t));
      if (t < 2) continue;
      const std::vector<Eigen::Index> seen = sums.seen();
      const std::vector<Eigen::Index> unseen = unseen_landmarks(history, t + 1);
      ASSERT_EQ(seen.size() + unseen.size(), 6U);
      const Proximities expected = proximities(with_rows(history, seen), t + 1);
      const Proximities found = sums.proximities_of(seen);
      expect_equal(found.squared_distances, expected.squared_distances);
      expect_equal(found.inner_products, expected.inner_products);
      EXPECT_EQ(found.apart_squared, expected.apart_squared);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Incremental, SumsOfEverySensor,
    ::testing::Values(std::pair{Sensor::kVisibility, 0.0}, std::pair{Sensor::kVisibility, 0.4},
                      std::pair{Sensor::kBearing, 0.0}, std::pair{Sensor::kBearing, 0.4},
                      std::pair{Sensor::kRange, 0.0}, std::pair{Sensor::kRange, 0.4}));

TEST(PairSums, TakeWhatIsNotListedAsNotSeenWhereDetectionsAloneAreListed) {
  const ObservationHistory history = random_history(Sensor::kVisibility, 0.0, 8);
  PairSums all(Sensor::kVisibility), detections(Sensor::kVisibility);
  all.grow(6);
  for (Eigen::Index t = 0; t < history.steps(); ++t) {
    std::vector<StepEntry> step = column_at(history, t);
    all.add(step);
    std::erase_if(step, [](const StepEntry& entry) { return entry.value == 0.0; });
    if (t == 0) detections.grow(3);
    if (t == 0) std::erase_if(step, [](const StepEntry& entry) { return entry.landmark >= 3; });
    if (t == 1) detections.grow(6);
    detections.add(step);
  }
  EXPECT_EQ(detections.seen(), all.seen());
  const Proximities expected = all.proximities_of(all.seen());
  const Proximities found = detections.proximities_of(detections.seen());
  // But for the first step's last three landmarks, which were left out above.
  EXPECT_LT((found.squared_distances - expected.squared_distances).cwiseAbs().maxCoeff(), 0.2);
  EXPECT_NEAR(found.squared_distances(0, 1), expected.squared_distances(0, 1), 1e-12);
}

TEST(PairSums, RefuseWhatIsNotAStep) {
  PairSums sums(Sensor::kRange);
  sums.grow(2);
  EXPECT_THROW(sums.add({{2, 1.0}}), InvalidInput);
  EXPECT_THROW(sums.add({{0, 1.0}, {0, 2.0}}), InvalidInput);
  EXPECT_THROW(sums.add({{0, NAN}}), InvalidInput);
  EXPECT_THROW(sums.grow(1), InvalidInput);
  EXPECT_EQ(sums.steps(), 0);
}

}  // namespace
}  // namespace mapproof
