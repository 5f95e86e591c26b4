#include <filesystem>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/text/words.hpp"
#include "reports/diff/records/record_diff.hpp"
#include "reports/history/judge_nightly_run.hpp"
#include "reports/history/nightly_scores.hpp"
#include "reports/model/format.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

/// What `diff` and a nightly run say of the same two records.
struct Judged {
  RecordDiff diff;
  NightlyRun nightly_run;
};

/// By how much the error of a method is multiplied in the second record.
using Factor = std::function<double(const std::string& method, int group)>;

/// A table of three methods, with four runs in each group.
std::filesystem::path write_table(const TemporaryFolder& folder, const std::string& name,
                                  int groups, const Factor& factor) {
  std::string table = "setup,method,quantity,run,group,value\n";
  for (const char* method : {"alpha", "beta", "gamma"})
    for (int run = 0; run < 4 * groups; ++run)
      table += fmt::format("indoors,{},ate_m,{},room-{},{:.9f}\n", method, run, run % groups,
                           (0.2 + 0.01 * run) * factor(method, run % groups));
  folder.file(name + "/results.csv", table);
  folder.file(name + "/study.json",
              R"({"schema": {"name": "mapproof.results_study", "version": 1}, "title": "Mine",
                  "quantities": [{"id": "ate_m", "label": "ATE", "unit": "m", "better": "lower"}]})");
  return folder / name;
}

NightlyRun nightly_run_of(const std::filesystem::path& folder, int number) {
  const std::string time = fmt::format("2026-01-01T00:{:02}:00Z", number);
  NightlyRun nightly_run{.facts = {.number = number,
                                   .started_utc = time,
                                   .ended_utc = time,
                                   .command = "mapproof nightly mine",
                                   .provenance = "{}",
                                   .host = "host"}};
  nightly_run.studies.push_back(read_nightly_study(folder, "mine"));
  return nightly_run;
}

Judged judged(
    int groups, const Factor& factor,
    const Factor& earlier = [](const std::string&, int) { return 1.0; }) {
  const TemporaryFolder folder;
  const auto before = write_table(folder, "before", groups, earlier);
  const auto after = write_table(folder, "after", groups, factor);
  std::filesystem::create_directory(folder / "history");
  HistoryStore store = HistoryStore::open(folder / "history");
  NightlyRun first = nightly_run_of(before, 1), second = nightly_run_of(after, 2);
  judge_nightly_run(store, first, std::nullopt);
  store.append(first);
  judge_nightly_run(store, second, std::nullopt);
  const RecordSets sets = read_records(before, after);
  return {record_diff(sets.baseline, sets.current), second};
}

TEST(OneRule, DiffAndANightlyRunFindTheSameInTheSameTwoRecords) {
  for (const int groups : {3, 5, 8, 30}) {
    const auto [diff, nightly_run] = judged(groups, [](const std::string& method, int group) {
      return method == "alpha" ? 1.2 + 0.004 * group : method == "beta" ? 1.0 : 0.9 - 0.002 * group;
    });
    ASSERT_EQ(diff.comparisons.size(), 2U) << groups;
    const Comparison& worse = diff.comparisons[0];
    EXPECT_EQ(worse.outcome, Outcome::kWorse);
    EXPECT_EQ(diff.comparisons[1].outcome, Outcome::kBetter);
    EXPECT_EQ(diff.judgement.cause.find("too few"), std::string::npos) << diff.judgement.cause;
    EXPECT_NE(diff.judgement.cause.find(p_words(worse.test->p)), std::string::npos)
        << diff.judgement.cause;
    ASSERT_EQ(nightly_run.findings.size(), 1U) << groups;
    EXPECT_EQ(nightly_run.findings[0].subject, "indoors, alpha");
    const std::string test = fmt::format(
        "{} over {}, {} corrected for 2 tests",
        worse.test->change.by_ranks ? "Wilcoxon's signed-rank test" : "Student's t test",
        counted(groups, worse.test->unit), small_p_words(worse.test->p));
    EXPECT_TRUE(nightly_run.findings[0].sentence.ends_with(test))
        << nightly_run.findings[0].sentence << "\n"
        << test;
  }
}

TEST(OneRule, OfEqualChangesInFewGroupsNeitherGivesAP) {
  const auto [diff, nightly_run] =
      judged(4, [](const std::string& method, int) { return method == "alpha" ? 1.2 : 1.0; });
  EXPECT_EQ(diff.judgement.verdict, Verdict::kWorse);
  ASSERT_EQ(nightly_run.findings.size(), 1U);
  for (const std::string& text : {diff.judgement.cause, nightly_run.findings[0].sentence}) {
    EXPECT_NE(text.find(kNoPWords), std::string::npos) << text;
    EXPECT_EQ(text.find("p ="), std::string::npos) << text;
    EXPECT_EQ(text.find("p <"), std::string::npos) << text;
  }
}

TEST(OneRule, SaysOfErrorsOfMapsThatDivergedByWhichFactorTheyChanged) {
  const auto factor = [](double of_alpha) {
    return [of_alpha](const std::string& method, int group) {
      return method == "alpha" ? of_alpha * (1.0 + 0.001 * group) : 1.0;
    };
  };
  const std::string words = "over 1\u00a0km before and after (1.30 times as great)";
  const auto [diff, nightly_run] = judged(6, factor(1.3e7), factor(1e7));
  ASSERT_EQ(diff.comparisons.size(), 1U) << "beta and gamma, which did not diverge, are equal";
  ASSERT_EQ(nightly_run.findings.size(), 1U);
  for (const std::string& text : {diff.judgement.cause, nightly_run.findings[0].sentence})
    EXPECT_NE(text.find(words), std::string::npos) << text;
}

TEST(OneRule, WhatIsNoiseToOneIsNoiseToTheOther) {
  const auto [diff, nightly_run] = judged(6, [](const std::string& method, int group) {
    return method == "alpha" ? (group % 2 == 0 ? 1.2 : 0.85) : 1.0;
  });
  EXPECT_EQ(diff.judgement.verdict, Verdict::kChanged);
  EXPECT_NE(diff.judgement.cause.find("neither better nor worse over the runs"), std::string::npos)
      << diff.judgement.cause;
  EXPECT_TRUE(nightly_run.findings.empty());
}

}  // namespace
}  // namespace mapproof::test
