#include "core/map_fit/map_fit.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/pairs/pair_map.hpp"
#include "tests/core/association/noisy_scans.hpp"

namespace mapproof {
namespace {

/// The fit of the map that is made of a log, with a check of its landmark IDs.
Fit fit_of(const DetectionLog& log, const Points* known_m = nullptr) {
  const AssociationCheck check = check_association(log);
  return range_bearing_fit(log, pair_map_of(log).embedding.coordinates,
                           {.known_m = known_m, .association = &check});
}

/// The scans in turn are of so many robots.
DetectionLog of_robots(DetectionLog log, int robots) {
  DetectionLog result = log;
  result.detections.clear();
  result.scans.clear();
  for (int robot = 0; robot < robots; ++robot)
    for (const Detection& seen : log.detections)
      if (seen.step % robots == robot) {
        result.detections.push_back(seen);
        result.detections.back().step = robot * (log.steps / robots) + seen.step / robots;
      }
  result.steps = log.steps / robots * robots;
  for (int step = 0; step < result.steps; ++step) {
    const int robot = step / (log.steps / robots);
    result.scans.push_back({robot, static_cast<double>(step % (log.steps / robots))});
  }
  std::erase_if(result.detections, [&](const Detection& one) { return one.step >= result.steps; });
  sort_detections(result.detections);
  return result;
}

const FitCause& first_cause(const Fit& fit) {
  static const FitCause kNone;
  return fit.causes.empty() ? kNone : fit.causes.front();
}

TEST(RangeBearingFit, FitsSoundScans) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    const DetectionLog log = test::noisy_scans(600, seed);
    const Points known_m = test::noisy_landmarks();
    EXPECT_EQ(fit_of(log).verdict, FitVerdict::kFits) << seed;
    EXPECT_EQ(fit_of(log, &known_m).verdict, FitVerdict::kFits) << seed;
  }
}

TEST(RangeBearingFit, NamesTwoIdsThatAreExchangedFromSomeTimeOn) {
  const DetectionLog log =
      test::swapped(test::noisy_scans(600, 1), 2, 11, [](int step) { return step >= 300; });
  const Fit fit = fit_of(log);
  EXPECT_EQ(fit.verdict, FitVerdict::kDoesNotFit);
  EXPECT_EQ(first_cause(fit).code, FitCode::kIdsExchanged);
  EXPECT_EQ(first_cause(fit).landmarks, (std::vector<std::string>{log.names[2], log.names[11]}));
}

TEST(RangeBearingFit, SeesRandomWrongIds) {
  for (const double share : {0.1, 0.3}) {
    DetectionLog log = test::noisy_scans(900, 2);
    Random random(5);
    for (std::size_t k = 0; k < log.detections.size(); ++k) {
      if (random.uniform() >= share) continue;
      const int other = static_cast<int>(random.uniform() * 15.0);
      const auto is_there = [&](const Detection& one) {
        return one.step == log.detections[k].step && one.landmark == other;
      };
      if (std::ranges::none_of(log.detections, is_there)) log.detections[k].landmark = other;
    }
    sort_detections(log.detections);
    EXPECT_EQ(fit_of(log).verdict, FitVerdict::kDoesNotFit) << share;
  }
}

TEST(RangeBearingFit, SeesARobotWithAnotherUnitAndOneWithTheOtherSign) {
  const DetectionLog log = of_robots(test::noisy_scans(900, 3), 3);
  EXPECT_EQ(fit_of(log).verdict, FitVerdict::kFits);
  DetectionLog feet = log;
  DetectionLog sign = log;
  for (std::size_t k = 0; k < log.detections.size(); ++k)
    if (log.scans[static_cast<std::size_t>(log.detections[k].step)].robot == 1) {
      feet.detections[k].range_m *= 3.2808;
      sign.detections[k].bearing_rad *= -1.0;
    }
  const Fit in_feet = fit_of(feet);
  EXPECT_EQ(in_feet.verdict, FitVerdict::kDoesNotFit);
  EXPECT_TRUE(std::ranges::any_of(
      in_feet.causes, [](const FitCause& cause) { return cause.code == FitCode::kRobotRanges; }));
  const Fit mirrored = fit_of(sign);
  EXPECT_EQ(mirrored.verdict, FitVerdict::kDoesNotFit);
  EXPECT_EQ(first_cause(mirrored).code, FitCode::kRobotBearings);
}

TEST(RangeBearingFit, SeesBearingsInAWrongUnit) {
  DetectionLog log = test::noisy_scans(600, 4);
  for (Detection& seen : log.detections) seen.bearing_rad *= std::numbers::pi / 180.0;
  EXPECT_EQ(fit_of(log).verdict, FitVerdict::kDoesNotFit);
}

TEST(RangeBearingFit, NamesTheKnownPositionsAtOdds) {
  const DetectionLog log = test::noisy_scans(600, 5);
  const Points known_m = test::noisy_landmarks();
  Points off = known_m;
  off.row(6) += Eigen::RowVector2d(2.0, 0.0);
  Fit fit = fit_of(log, &off);
  EXPECT_EQ(fit.verdict, FitVerdict::kDoesNotFit);
  EXPECT_EQ(first_cause(fit).code, FitCode::kKnownLandmarkOff);
  EXPECT_EQ(first_cause(fit).landmarks, (std::vector<std::string>{log.names[6]}));
  Points exchanged = known_m;
  exchanged.row(1).swap(exchanged.row(13));
  fit = fit_of(log, &exchanged);
  EXPECT_EQ(first_cause(fit).code, FitCode::kKnownLandmarksExchanged);
  Points mirrored = known_m;
  mirrored.col(1) *= -1.0;
  EXPECT_EQ(first_cause(fit_of(log, &mirrored)).code, FitCode::kKnownMirrored);
  const Points in_feet = 3.2808 * known_m;
  EXPECT_EQ(first_cause(fit_of(log, &in_feet)).code, FitCode::kKnownScale);
}

TEST(RangeBearingFit, DoesNotDependOnTheUnitOfLength) {
  const DetectionLog log = test::noisy_scans(600, 6);
  DetectionLog longer = log;
  for (Detection& seen : longer.detections) seen.range_m *= 40.0;
  const Fit here = fit_of(log);
  const Fit there = fit_of(longer);
  ASSERT_EQ(here.tests.size(), there.tests.size());
  for (std::size_t k = 0; k < here.tests.size(); ++k)
    EXPECT_NEAR(here.tests[k].statistic, there.tests[k].statistic,
                0.02 * here.tests[k].bound + 0.02 * here.tests[k].statistic)
        << name(here.tests[k].code);
}

TEST(RangeBearingFit, NamesTheGroupsThatFewPairsJoin) {
  // Two rooms; three pairs of landmarks, each in two scans, join them.
  const DetectionLog room = test::noisy_scans(400, 7);
  DetectionLog log = room;
  for (const std::string& name : room.names) log.names.push_back("b" + name);
  for (Detection seen : room.detections) {
    seen.step += room.steps;
    seen.landmark += 15;
    log.detections.push_back(seen);
  }
  log.steps = 2 * room.steps;
  for (int k = 0; k < 6; ++k) {
    log.detections.push_back({log.steps, k / 2, 5.0, -0.5});
    log.detections.push_back({log.steps, 15 + k / 2, 6.0, 0.5});
    ++log.steps;
  }
  const Fit fit = fit_of(log);
  EXPECT_EQ(fit.verdict, FitVerdict::kUndetermined);
  ASSERT_EQ(fit.parts.size(), 2U);
  EXPECT_EQ(fit.parts[0].size(), 15U);
  EXPECT_EQ(fit.parts[1].size(), 15U);
}

TEST(RangeBearingFit, CannotBeTestedWithoutRedundancy) {
  DetectionLog log = test::noisy_scans(5, 8);
  const Fit fit = range_bearing_fit(log, pair_map_of(log).embedding.coordinates, {});
  EXPECT_EQ(fit.verdict, FitVerdict::kNotTestable);
  EXPECT_FALSE(fit.why.empty());
}

}  // namespace
}  // namespace mapproof
