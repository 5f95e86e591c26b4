#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/judge_nightly_run.hpp"
#include "tests/reports/history/sample_nightly_runs.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

std::vector<std::string> subjects(const NightlyRun& nightly_run) {
  std::vector<std::string> found;
  for (const NightlyFinding& finding : nightly_run.findings)
    found.push_back(std::string(name(finding.rule)) + ": " + finding.subject);
  return found;
}

TEST(HistoryWeek, PlantedRegressionsAreNamedOnNightlyRunFiveAndNothingElseIs) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 7; ++number) {
    Plant plant;
    if (number >= 5) {
      plant.error = {{"isomap-K6", 1.08}};
      plant.seconds = {{"lle-K6", 1.4}};
    }
    const NightlyRun nightly_run = judged(store, sample_nightly_run(number, 11, plant));
    if (number < 5) {
      EXPECT_EQ(nightly_run.facts.verdict, NightlyVerdict::kPassed) << number;
      EXPECT_TRUE(nightly_run.findings.empty()) << number;
      continue;
    }
    EXPECT_EQ(nightly_run.facts.verdict, NightlyVerdict::kAccuracy);
    EXPECT_EQ(nightly_run.facts.reference, 4);
    EXPECT_EQ(subjects(nightly_run),
              (std::vector<std::string>{"accuracy: bearing, isomap-K6, 2000 steps",
                                        "seconds: bearing, lle-K6"}));
    for (const NightlyFinding& finding : nightly_run.findings) EXPECT_EQ(finding.since, 5);
    const std::string& sentence = nightly_run.findings.front().sentence;
    EXPECT_TRUE(sentence.starts_with("bearing, ISOMAP, K = 6, 2000 steps: MPE ")) << sentence;
    EXPECT_EQ(sentence.find(" %"), std::string::npos) << "no line ends before its unit";
  }
}

TEST(HistoryWeek, ASlowdownAloneIsOfCost) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 4; ++number) judged(store, sample_nightly_run(number, 3));
  const NightlyRun nightly_run =
      judged(store, sample_nightly_run(5, 3, {.seconds = {{"smacof", 1.5}}}));
  EXPECT_EQ(nightly_run.facts.verdict, NightlyVerdict::kCost);
  EXPECT_EQ(subjects(nightly_run), std::vector<std::string>{"seconds: bearing, smacof"});
}

TEST(HistoryWeek, ASingleBusyNightlyRunIsNotFlaggedTwoInARowAre) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 6; ++number) judged(store, sample_nightly_run(number, 5));
  const Plant busy{.all_seconds = 2.0, .memory = 1.3};
  EXPECT_TRUE(judged(store, sample_nightly_run(7, 5, busy)).findings.empty());
  EXPECT_TRUE(judged(store, sample_nightly_run(8, 5)).findings.empty());
  EXPECT_TRUE(judged(store, sample_nightly_run(9, 5, busy)).findings.empty());
  const NightlyRun second = judged(store, sample_nightly_run(10, 5, busy));
  EXPECT_EQ(subjects(second),
            (std::vector<std::string>{"all-seconds: all methods", "memory: the whole study"}));
  for (const NightlyFinding& finding : second.findings) EXPECT_EQ(finding.since, 9);
}

TEST(HistoryWeek, ASlowDriftIsFoundWithAboutTheNightlyRunItBegan) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  std::optional<NightlyFinding> first;
  for (int number = 1; number <= 40 && !first; ++number) {
    // Each nightly run by .4 %: less than counts from one nightly run to the next.
    const double drift = std::pow(1.004, std::max(0, number - 12));
    const NightlyRun nightly_run = judged(
        store, sample_nightly_run(number, 9, {.error = {{"lpca", drift}}, .error_noise = 0.002}));
    for (const NightlyFinding& finding : nightly_run.findings)
      if (finding.rule == HistoryRule::kAccuracyDrift) first = finding;
  }
  ASSERT_TRUE(first.has_value());
  EXPECT_EQ(first->subject, "bearing, lpca");
  EXPECT_NEAR(first->since, 13, 6);
}

TEST(HistoryWeek, APinnedNightlyRunIsAcceptedAsItIs) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  const Plant worse{.error = {{"lpca", 1.2}}};
  judged(store, sample_nightly_run(1, 2));
  EXPECT_EQ(judged(store, sample_nightly_run(2, 2, worse)).facts.verdict,
            NightlyVerdict::kAccuracy);
  store.pin(2);
  const NightlyRun nightly_run = judged(store, sample_nightly_run(3, 2, worse));
  EXPECT_EQ(nightly_run.facts.reference, 2);
  EXPECT_TRUE(nightly_run.findings.empty());
  EXPECT_THROW(store.pin(99), InvalidInput);
}

TEST(HistoryWeek, LostMapsAreReported) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  judged(store, sample_nightly_run(1, 2));
  NightlyRun nightly_run = sample_nightly_run(2, 2);
  for (RunValue& value : nightly_run.studies[0].scores[{"bearing", "smacof", 2000, "mpe_m"}])
    value.value = std::nan("");
  EXPECT_EQ(subjects(judged(store, nightly_run)),
            std::vector<std::string>{"lost-results: bearing, smacof"});
}

TEST(HistoryWeek, AClockThatJumpedIsSaid) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  judged(store, sample_nightly_run(1, 2));
  NightlyRun nightly_run = sample_nightly_run(2, 2);
  nightly_run.facts.started_utc = "1999-01-01T00:00:00Z";
  const auto remarks = judge_nightly_run(store, nightly_run, std::nullopt);
  EXPECT_NE(remarks.front().find("the clock stands at 1999"), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
