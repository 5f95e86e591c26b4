#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/judge_night.hpp"
#include "tests/reports/history/sample_nights.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

std::vector<std::string> subjects(const Night& night) {
  std::vector<std::string> found;
  for (const NightFinding& finding : night.findings)
    found.push_back(std::string(name(finding.rule)) + ": " + finding.subject);
  return found;
}

TEST(HistoryWeek, PlantedRegressionsAreNamedOnNightFiveAndNothingElseIs) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 7; ++number) {
    Plant plant;
    if (number >= 5) {
      plant.error = {{"isomap-K6", 1.08}};
      plant.seconds = {{"lle-K6", 1.4}};
    }
    const Night night = judged(store, sample_night(number, 11, plant));
    if (number < 5) {
      EXPECT_EQ(night.facts.verdict, NightVerdict::kGood) << number;
      EXPECT_TRUE(night.findings.empty()) << number;
      continue;
    }
    EXPECT_EQ(night.facts.verdict, NightVerdict::kAccuracy);
    EXPECT_EQ(night.facts.reference, 4);
    EXPECT_EQ(subjects(night), (std::vector<std::string>{"accuracy: bearing, isomap-K6, 2000 steps",
                                                         "seconds: bearing, lle-K6"}));
    for (const NightFinding& finding : night.findings) EXPECT_EQ(finding.since, 5);
    const std::string& sentence = night.findings.front().sentence;
    EXPECT_TRUE(sentence.starts_with("bearing, ISOMAP, K = 6, 2000 steps: MPE ")) << sentence;
    EXPECT_EQ(sentence.find(" %"), std::string::npos) << "no line ends before its unit";
  }
}

TEST(HistoryWeek, ASlowdownAloneIsOfCost) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 4; ++number) judged(store, sample_night(number, 3));
  const Night night = judged(store, sample_night(5, 3, {.seconds = {{"smacof", 1.5}}}));
  EXPECT_EQ(night.facts.verdict, NightVerdict::kCost);
  EXPECT_EQ(subjects(night), std::vector<std::string>{"seconds: bearing, smacof"});
}

TEST(HistoryWeek, ASingleBusyNightIsNotFlaggedTwoInARowAre) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 6; ++number) judged(store, sample_night(number, 5));
  const Plant busy{.all_seconds = 2.0, .memory = 1.3};
  EXPECT_TRUE(judged(store, sample_night(7, 5, busy)).findings.empty());
  EXPECT_TRUE(judged(store, sample_night(8, 5)).findings.empty());
  EXPECT_TRUE(judged(store, sample_night(9, 5, busy)).findings.empty());
  const Night second = judged(store, sample_night(10, 5, busy));
  EXPECT_EQ(subjects(second),
            (std::vector<std::string>{"all-seconds: all methods", "memory: the whole study"}));
  for (const NightFinding& finding : second.findings) EXPECT_EQ(finding.since, 9);
}

TEST(HistoryWeek, ASlowDriftIsFoundWithAboutTheNightItBegan) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  std::optional<NightFinding> first;
  for (int number = 1; number <= 40 && !first; ++number) {
    // Each nightly run by .4 %: less than counts from one nightly run to the next.
    const double drift = std::pow(1.004, std::max(0, number - 12));
    const Night night =
        judged(store, sample_night(number, 9, {.error = {{"lpca", drift}}, .error_noise = 0.002}));
    for (const NightFinding& finding : night.findings)
      if (finding.rule == NightRule::kAccuracyDrift) first = finding;
  }
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->subject, "bearing, lpca");
  EXPECT_NEAR(first->since, 13, 6);
}

TEST(HistoryWeek, APinnedNightIsAcceptedAsItIs) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  const Plant worse{.error = {{"lpca", 1.2}}};
  judged(store, sample_night(1, 2));
  EXPECT_EQ(judged(store, sample_night(2, 2, worse)).facts.verdict, NightVerdict::kAccuracy);
  store.pin(2);
  const Night night = judged(store, sample_night(3, 2, worse));
  EXPECT_EQ(night.facts.reference, 2);
  EXPECT_TRUE(night.findings.empty());
  EXPECT_THROW(store.pin(99), InvalidInput);
}

TEST(HistoryWeek, LostMapsAreTold) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  judged(store, sample_night(1, 2));
  Night night = sample_night(2, 2);
  for (RunValue& value : night.studies[0].scores[{"bearing", "smacof", 2000, "mpe_m"}])
    value.value = std::nan("");
  EXPECT_EQ(subjects(judged(store, night)),
            std::vector<std::string>{"lost-results: bearing, smacof"});
}

TEST(HistoryWeek, AClockThatJumpedIsSaid) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  judged(store, sample_night(1, 2));
  Night night = sample_night(2, 2);
  night.facts.started_utc = "1999-01-01T00:00:00Z";
  const auto remarks = judge_night(store, night, std::nullopt);
  EXPECT_NE(remarks.front().find("the clock stands at 1999"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
