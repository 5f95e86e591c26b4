#include "core/missing/missing_pattern.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "core/simulate/missing_entries.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/samples/incomplete.hpp"

namespace mapproof {
namespace {

/// Bearings or ranges of a room, some of them missing.
struct Incomplete {
  test::WalkedRoom room = test::walked_room(3, 1000);
  ObservationHistory whole;

  explicit Incomplete(Sensor sensor) {
    Random random(7);
    whole = observe(room.world, room.path, {.sensor = sensor}, random);
  }
  ObservationHistory at_random(double share) const {
    Random random(8);
    return with_missing(whole, random_losses(50, 1000, random), share);
  }
  ObservationHistory out_of_range(double share) const {
    return with_missing(whole, range_losses(room.world, room.path), share);
  }
  ObservationHistory hidden(double share) const {
    return with_missing(whole, occlusion_losses(room.world, room.path), share);
  }
};

MissingStrategy way_of(const ObservationHistory& history) {
  return advised_strategy(missing_pattern(history, history.steps()), history.sensor).strategy;
}

TEST(MissingPattern, IsRandomWhereEntriesAreMissingAtRandom) {
  const MissingPattern pattern = missing_pattern(Incomplete(Sensor::kBearing).at_random(0.4), 1000);
  EXPECT_NEAR(pattern.missing_share, 0.4, 1e-9);
  EXPECT_NEAR(pattern.dispersion, 1.0, 0.1);
  EXPECT_NEAR(pattern.nearness, 0.0, 0.15);
  EXPECT_EQ(pattern.few_share, 0.0);
}

TEST(MissingPattern, RecognisesASensorOfShortRangeByNearnessAndPairsApart) {
  const MissingPattern pattern =
      missing_pattern(Incomplete(Sensor::kBearing).out_of_range(0.85), 1000);
  EXPECT_GT(pattern.dispersion, 5.0);
  EXPECT_LT(pattern.nearness, -0.6);
  EXPECT_GT(pattern.apart_share, 0.1);
  EXPECT_LE(pattern.apart_share, pattern.few_share);
}

TEST(MissingPattern, IsEmptyWithoutMissingData) {
  const MissingPattern pattern = missing_pattern(Incomplete(Sensor::kRange).whole, 500);
  EXPECT_EQ(pattern.missing_share, 0.0);
  EXPECT_EQ(pattern.dispersion, 0.0);
}

TEST(StrategyAdvice, IsTheBestStrategyForEachPatternOfMissingData) {
  const Incomplete bearing(Sensor::kBearing);
  EXPECT_EQ(way_of(bearing.whole), MissingStrategy::kPairwiseComplete);
  for (const double share : {0.1, 0.3, 0.5, 0.7}) {
    EXPECT_EQ(way_of(bearing.at_random(share)), MissingStrategy::kPpca) << share;
    // A tenth out of range is not distinguished from hidden ones, and matters little.
    if (share > 0.1) {
      EXPECT_EQ(way_of(bearing.out_of_range(share)), MissingStrategy::kPairwiseComplete) << share;
    }
    EXPECT_EQ(way_of(bearing.hidden(share)), MissingStrategy::kPpca) << share;
  }
  const Incomplete range(Sensor::kRange);
  EXPECT_EQ(way_of(range.at_random(0.5)), MissingStrategy::kPpca);
  EXPECT_EQ(way_of(range.hidden(0.5)), MissingStrategy::kPpca);
  EXPECT_EQ(way_of(range.out_of_range(0.9)), MissingStrategy::kCovisible);
}

TEST(MedianDisagreement, IsTheShareByWhichOneScaleDiffers) {
  const Proximities common = proximities(Incomplete(Sensor::kBearing).whole, 200);
  Proximities longer = common;
  longer.squared_distances *= 1.21;
  EXPECT_NEAR(median_disagreement(longer, common), 0.1, 1e-12);
}

}  // namespace
}  // namespace mapproof
