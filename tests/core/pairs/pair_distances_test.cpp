#include "core/pairs/pair_distances.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "tests/support/samples/scans.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

/// One scan of A and B.
DetectionLog one_scan(Detection a, Detection b) {
  a.landmark = 0;
  b.landmark = 1;
  return {.names = {"A", "B"}, .detections = {a, b}, .steps = 1, .times_s = {}};
}

/// Scans of A and B that measure these distances, B straight behind A.
DetectionLog scans_of(const std::vector<double>& distances) {
  DetectionLog log{.names = {"A", "B"}, .detections = {}, .steps = 0, .times_s = {}};
  for (const double distance : distances) {
    log.detections.push_back({.step = log.steps, .landmark = 0, .range_m = 1, .bearing_rad = 0.3});
    log.detections.push_back(
        {.step = log.steps, .landmark = 1, .range_m = 1 + distance, .bearing_rad = 0.3});
    ++log.steps;
  }
  return log;
}

TEST(PairDistances, ThreeAndFourAtARightAngleAreFive) {
  const auto pairs =
      measured_pairs(one_scan({.range_m = 3, .bearing_rad = -0.2},
                              {.range_m = 4, .bearing_rad = -0.2 + std::numbers::pi / 2}));
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_NEAR(pairs[0].distance_m, 5.0, 1e-14);
  EXPECT_EQ(pairs[0].scans, 1);
}

TEST(PairDistances, AHeadingChangeBeyondThePoleChangesNothing) {
  const auto pairs = measured_pairs(
      one_scan({.range_m = 3, .bearing_rad = 3.1}, {.range_m = 3, .bearing_rad = -3.1}));
  EXPECT_NEAR(pairs.at(0).distance_m, 6.0 * std::sin(std::numbers::pi - 3.1), 1e-14);
}

TEST(PairDistances, AScanThatLacksANumberMeasuresNothing) {
  EXPECT_TRUE(measured_pairs(
                  one_scan({.range_m = 3, .bearing_rad = kNaN}, {.range_m = 4, .bearing_rad = 1}))
                  .empty());
  EXPECT_TRUE(measured_pairs(
                  one_scan({.range_m = 3, .bearing_rad = 0}, {.range_m = kNaN, .bearing_rad = 1}))
                  .empty());
}

TEST(PairDistances, AreThoseOfTheLandmarks) {
  const Points landmarks = test::scattered(12, 3);
  const auto pairs = measured_pairs(test::scans_at(landmarks, 300, 4, 5));
  EXPECT_GT(pairs.size(), 30U);
  for (const MeasuredPair& pair : pairs)
    EXPECT_NEAR(pair.distance_m, (landmarks.row(pair.first) - landmarks.row(pair.second)).norm(),
                1e-13);
}

TEST(PairDistances, DoNotDependOnTheOrderOfTheScansNorOnTheHeadings) {
  const DetectionLog log = test::scans_at(test::scattered(10, 1), 200, 4, 2);
  DetectionLog other = log;
  Random random(9);
  std::vector<double> turns;
  for (int step = 0; step < log.steps; ++step) turns.push_back(random.uniform());
  for (Detection& seen : other.detections) {
    seen.bearing_rad += turns[static_cast<std::size_t>(seen.step)];
    seen.step = log.steps - 1 - seen.step;
  }
  std::ranges::stable_sort(other.detections, {}, &Detection::step);
  const auto pairs = measured_pairs(log);
  const auto others = measured_pairs(other);
  ASSERT_EQ(pairs.size(), others.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    EXPECT_EQ(pairs[k].scans, others[k].scans);
    EXPECT_NEAR(pairs[k].distance_m, others[k].distance_m, 1e-13);
    EXPECT_NEAR(pairs[k].precision / others[k].precision, 1.0, 1e-9);
  }
}

TEST(PairDistances, AreTheMedianOfTheirScans) {
  EXPECT_NEAR(measured_pairs(scans_of({2.0, 2.1, 77.0})).at(0).distance_m, 2.1, 1e-13);
}

TEST(PairDistances, HaveThePrecisionOfTheirScatterAndNumberOfScans) {
  // Scatter 1.4826 * 0.1, in the pair's own scans and in the median pair's, which it is.
  const PairNoise noise{.relative = 0.02, .floor = 0.01};
  const double variance =
      std::pow(0.02 * 2.0, 2) + std::pow(0.01 * 2.0, 2) + std::pow(0.14826, 2) / 5.0;
  EXPECT_NEAR(measured_pairs(scans_of({1.8, 1.9, 2.0, 2.1, 2.2}), noise).at(0).precision,
              1.0 / variance, 1e-9 / variance);
}

TEST(PairDistances, ManyScansOfAPairAreTakenFromAllOverTheLog) {
  std::vector<double> distances(10000, 1.0);
  std::fill(distances.begin() + 4000, distances.end(), 3.0);
  const auto pairs = measured_pairs(scans_of(distances));
  EXPECT_EQ(pairs.at(0).scans, 10000);
  EXPECT_NEAR(pairs[0].distance_m, 3.0, 1e-13);
}

TEST(PairDistances, RefuseWhatIsNotALog) {
  DetectionLog log = scans_of({1.0, 2.0});
  std::swap(log.detections.front(), log.detections.back());
  EXPECT_THROW(measured_pairs(log), InvalidInput);
  log = scans_of({1.0});
  log.detections.back().landmark = 2;
  EXPECT_THROW(measured_pairs(log), InvalidInput);
  log = scans_of({1.0});
  log.detections.back().range_m = -1.0;
  EXPECT_THROW(measured_pairs(log), InvalidInput);
  EXPECT_THROW(measured_pairs(scans_of({1.0}), {.relative = -0.1}), InvalidInput);
}

}  // namespace
}  // namespace mapproof
