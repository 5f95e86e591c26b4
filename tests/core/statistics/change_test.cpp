#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/statistics/paired_change.hpp"
#include "core/statistics/robust_noise.hpp"

namespace mapproof {
namespace {

std::vector<double> noise(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(random.normal());
  return values;
}

TEST(PairedChange, OfFewPairsIsStudentsT) {
  const PairedChange change = paired_change(std::vector{1.0, 2.0, 3.0, 4.0, 5.0});
  EXPECT_FALSE(change.by_ranks);
  EXPECT_NEAR(change.shift, 3.0, 1e-12);
  EXPECT_NEAR(change.p, 0.0132356, 1e-7);  // scipy.stats.ttest_1samp.
  EXPECT_NEAR(change.low, 3.0 - 1.963243, 1e-5);
}

TEST(PairedChange, OfManyPairsIsTheMedianOfWalshAveragesAndOneOutlierDoesNotMoveIt) {
  std::vector<double> differences;
  for (int i = 0; i < 25; ++i) differences.push_back(1.0 + 0.01 * i);
  const PairedChange clean = paired_change(differences);
  EXPECT_TRUE(clean.by_ranks);
  EXPECT_NEAR(clean.shift, 1.12, 1e-12);
  EXPECT_LT(clean.p, 1e-7);
  EXPECT_LT(clean.low, 1.12);
  EXPECT_GT(clean.low, 1.0);
  differences[3] = 1e14;
  EXPECT_NEAR(paired_change(differences).shift, 1.12, 0.02);
}

TEST(PairedChange, HasTheEndsAndTheMiddleOfAllWalshAverages) {
  for (const int n : {21, 22, 60}) {
    std::vector<double> differences = noise(n, static_cast<std::uint64_t>(n));
    differences[1] = differences[0];
    differences[2] = -differences[0];
    differences[3] = 1e-300;
    std::vector<double> averages;
    for (std::size_t i = 0; i < differences.size(); ++i)
      for (std::size_t j = i; j < differences.size(); ++j)
        averages.push_back(0.5 * differences[i] + 0.5 * differences[j]);
    std::ranges::sort(averages);
    const PairedChange change = paired_change(differences);
    ASSERT_TRUE(change.by_ranks);
    const std::size_t half = averages.size() / 2;
    EXPECT_EQ(change.shift, averages.size() % 2 == 1
                                ? averages[half]
                                : 0.5 * averages[half - 1] + 0.5 * averages[half]);
    // An interval's ends are averages that as many others lie beyond, on either side.
    const auto low = std::ranges::lower_bound(averages, change.low);
    const auto high = std::ranges::upper_bound(averages, change.high);
    EXPECT_EQ(*low, change.low);
    EXPECT_EQ(low - averages.begin(), averages.end() - high);
  }
}

TEST(PairedChange, OfAHundredThousandPairsHasANarrowInterval) {
  std::vector<double> differences = noise(100'000, 5);
  for (double& difference : differences) difference += 0.02;
  const PairedChange change = paired_change(differences);
  EXPECT_NEAR(change.shift, 0.02, 0.01);
  // Of a normal the estimate has the standard error sqrt(pi / 3 / n).
  EXPECT_NEAR(change.high - change.low, 2.0 * 1.96 * std::sqrt(1.0472 / 1e5), 1e-4);
}

TEST(PairedChange, NothingChangedHasNoP) {
  for (const int n : {1, 2, 5, 30})
    EXPECT_EQ(paired_change(std::vector<double>(static_cast<std::size_t>(n), 0.0)).p, 1.0) << n;
}

TEST(PairedChange, IntervalsHaveTheirNominalCoverage) {
  for (const int n : {8, 25}) {
    int held = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
      const PairedChange change = paired_change(noise(n, seed));
      held += change.low <= 0.0 && change.high >= 0.0;
    }
    EXPECT_NEAR(held / 2000.0, 0.95, 0.015) << n;
  }
}

TEST(PairedChange, RefusesInvalidDifferences) {
  EXPECT_THROW(paired_change({}), InvalidInput);
  EXPECT_THROW(paired_change(std::vector{1.0, std::nan("")}), InvalidInput);
}

TEST(RobustNoise, IsTheStandardDeviationOfANormalAndHalfOfItMayBeOutliers) {
  std::vector<double> values = noise(20'000, 7);
  EXPECT_NEAR(robust_noise(values).sigma, 1.0, 0.03);
  for (std::size_t i = 0; i < 1000; ++i) values[i] = 1e9;
  EXPECT_NEAR(robust_noise(values).sigma, 1.0, 0.1);
}

TEST(RobustNoise, LimitsOfFewValuesAreCrossedAboutAsSeldomAsRequested) {
  for (const int n : {5, 10, 20}) {
    int crossed = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
      std::vector<double> values = noise(n + 1, seed);
      const double next = values.back();
      values.pop_back();
      crossed += next > upper_limit(robust_noise(values), 0.01, 0.0);
    }
    EXPECT_LT(crossed / 20'000.0, 0.025) << n;
    EXPECT_GT(crossed / 20'000.0, 0.001) << n;
  }
}

TEST(ChangePoint, FindsAStepWhereItIs) {
  std::vector<double> values = noise(40, 3);
  for (std::size_t i = 25; i < values.size(); ++i) values[i] += 5.0;
  const ChangePoint change = rise_in(values);
  EXPECT_LT(change.p, 1e-4);
  EXPECT_EQ(change.first, 25);
  EXPECT_FALSE(change.gradual);
  EXPECT_NEAR(change.rise, 5.0, 1.3);  // Three standard errors of the medians.
}

TEST(ChangePoint, FindsWhereASlowDriftBegins) {
  std::vector<double> values = noise(60, 4);
  for (std::size_t i = 30; i < values.size(); ++i) values[i] += 0.4 * static_cast<double>(i - 29);
  const ChangePoint change = rise_in(values);
  EXPECT_LT(change.p, 1e-4);
  EXPECT_TRUE(change.gradual);
  EXPECT_NEAR(change.first, 30, 6);
}

TEST(ChangePoint, OneOutlierIsNotAChange) {
  std::vector<double> values(30, 1.0);
  values[20] = 1e6;
  EXPECT_GT(rise_in(values).p, 0.5);
}

TEST(ChangePoint, AFallIsNotARise) {
  std::vector<double> values(30, 1.0);
  for (std::size_t i = 15; i < 30; ++i) values[i] = 0.0;
  EXPECT_EQ(rise_in(values).p, 1.0);
}

TEST(ChangePoint, FalseAlarmsAreNoMoreThanRequested) {
  int alarms = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) alarms += rise_in(noise(30, seed)).p < 0.01;
  EXPECT_LE(alarms, 40);
}

}  // namespace
}  // namespace mapproof
