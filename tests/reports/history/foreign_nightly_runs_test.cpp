#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/records/studies/results_study_json.hpp"
#include "reports/history/accuracy_rule.hpp"
#include "reports/history/judge_nightly_run.hpp"
#include "reports/history/nightly_scores.hpp"
#include "reports/history/pages/history_tables.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

/// Nightly runs of a table of results: three methods at four noises in two quantities, 18 runs in
/// six groups or another number of them. What a run scores is the same in every nightly run.
struct ForeignNightlyRun {
  int groups = 6;
  std::function<bool(const SeriesId&, int run)> is_there = [](const SeriesId&, int) {
    return true;
  };
  std::function<double(const SeriesId&, int run)> factor = [](const SeriesId&, int) { return 1.0; };
  std::string setup = "indoors";
  int step = 0;
  StudyLabels labels = {};
};

NightlyRun nightly_of(int number, const ForeignNightlyRun& plan = {}) {
  NightlyRun nightly_run{.facts = {.number = number,
                                   .started_utc = fmt::format("2026-01-01T00:{:02}:00Z", number),
                                   .ended_utc = fmt::format("2026-01-01T00:{:02}:00Z", number),
                                   .command = "mapproof nightly mine",
                                   .provenance = "{}",
                                   .host = "host"}};
  NightlyStudy study{.name = "mine",
                     .kind = std::string(kResultsStudy),
                     .experiment_digest = "d",
                     .draws_groups = true,
                     .runs = 18};
  study.labels = plan.labels;
  study.quantities.declare(study_quantity("ate_m", "ATE", "m", Better::kLower));
  study.quantities.declare(study_quantity("found", "found", "%", Better::kHigher));
  for (const char* method : {"alpha", "scan matching", "gamma"})
    for (const char* noise : {"0.1", "0.2", "0.4", "0.8"})
      for (const char* quantity : {"ate_m", "found"}) {
        const SeriesId series{plan.setup, fmt::format("{} noise={}", method, noise), plan.step,
                              quantity};
        for (int run = 1; run <= 18; ++run) {
          if (!plan.is_there(series, run)) continue;
          const double value = (quantity[0] == 'a' ? 0.2 : 50.0) * (1.0 + 0.01 * run);
          study.scores[series].push_back({fmt::format("{:02}", run),
                                          fmt::format("g{}", run % plan.groups),
                                          value * plan.factor(series, run)});
        }
      }
  nightly_run.studies.push_back(std::move(study));
  return nightly_run;
}

NightlyRun second_nightly_run(const ForeignNightlyRun& first, const ForeignNightlyRun& second,
                              std::vector<std::string>* remarks = nullptr) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  NightlyRun nightly_run = nightly_of(1, first);
  judge_nightly_run(store, nightly_run, std::nullopt);
  store.append(nightly_run);
  NightlyRun next = nightly_of(2, second);
  const std::vector<std::string> reported = judge_nightly_run(store, next, std::nullopt);
  if (remarks != nullptr) *remarks = reported;
  store.append(next);
  // The one after it is compared with the last passing one.
  NightlyRun third = nightly_of(3, second);
  EXPECT_EQ(reference_nightly_run(store, third, std::nullopt),
            next.facts.verdict == NightlyVerdict::kPassed ? 2 : 1);
  return next;
}

std::vector<std::string> reported(const NightlyRun& nightly_run) {
  std::vector<std::string> found;
  for (const NightlyFinding& finding : nightly_run.findings)
    found.push_back(
        fmt::format("{}: {}: {}", name(finding.rule), finding.subject, finding.quantity));
  return found;
}

TEST(ForeignNightlyRuns, AMethodThatIsMissingIsAFailureAndNoReference) {
  const NightlyRun nightly_run =
      second_nightly_run({}, {.is_there = [](const SeriesId& series, int) {
                           return !series.method.starts_with("scan matching");
                         }});
  EXPECT_EQ(nightly_run.facts.verdict, NightlyVerdict::kAccuracy);
  EXPECT_EQ(reported(nightly_run),
            std::vector<std::string>{"lost-results: indoors, scan matching: ate_m"});
  EXPECT_EQ(nightly_run.findings[0].sentence,
            "indoors, scan matching: no result any more, where nightly run 1 had 8 series (ATE and "
            "found)");
}

TEST(ForeignNightlyRuns, AQuantityASetupOrALevelThatIsMissingIsAFailure) {
  const auto without = [](const std::function<bool(const SeriesId&)>& is_gone) {
    return reported(second_nightly_run(
        {}, {.is_there = [=](const SeriesId& series, int) { return !is_gone(series); }}));
  };
  EXPECT_EQ(without([](const SeriesId& series) { return series.quantity == "found"; }),
            std::vector<std::string>{"lost-results: all methods: found"});
  EXPECT_EQ(without([](const SeriesId& series) {
              return series.method == "gamma noise=0.8" && series.quantity == "ate_m";
            }),
            std::vector<std::string>{"lost-results: indoors, gamma noise=0.8: ate_m"});
  EXPECT_EQ(reported(second_nightly_run({}, {.setup = "outdoors"})),
            std::vector<std::string>{"lost-results: indoors: ate_m"});
}

TEST(ForeignNightlyRuns, TheLossOfManyResultsIsAFailureHoweverItIsWritten) {
  const auto is_lost = [](const SeriesId& series, int run) {
    return series.method == "gamma noise=0.4" && run <= 14;
  };
  const ForeignNightlyRun gone{
      .is_there = [=](const SeriesId& series, int run) { return !is_lost(series, run); }};
  const ForeignNightlyRun empty{.factor = [=](const SeriesId& series, int run) {
    return is_lost(series, run) ? std::numeric_limits<double>::quiet_NaN() : 1.0;
  }};
  for (const ForeignNightlyRun& plan : {gone, empty}) {
    const NightlyRun nightly_run = second_nightly_run({}, plan);
    EXPECT_EQ(nightly_run.facts.verdict, NightlyVerdict::kAccuracy);
    ASSERT_EQ(reported(nightly_run),
              std::vector<std::string>{"lost-results: indoors, gamma noise=0.4: ate_m"});
    EXPECT_NE(nightly_run.findings[0].sentence.find(
                  "14 of the 18 results of nightly run 1 no longer come out"),
              std::string::npos);
  }
}

TEST(ForeignNightlyRuns, AFewLostResultsAreRemarkedOn) {
  std::vector<std::string> remarks;
  const ForeignNightlyRun plan{.is_there = [](const SeriesId& series, int run) {
    return series.method != "gamma noise=0.4" || run > 2;
  }};
  const NightlyRun nightly_run = second_nightly_run({}, plan, &remarks);
  EXPECT_TRUE(nightly_run.findings.empty());
  ASSERT_FALSE(remarks.empty());
  EXPECT_EQ(
      remarks[0],
      "mine: 2 results of nightly run 1 no longer come out, of indoors, gamma, noise 0.4; too few "
      "of each to be judged");
}

TEST(ForeignNightlyRuns, SayHowManyMustPassBeforeCostsAreJudged) {
  std::vector<std::string> remarks;
  second_nightly_run({}, {}, &remarks);
  EXPECT_NE(std::ranges::find(remarks,
                              "mine: seconds and memory of a single nightly run are not judged "
                              "yet: that takes 4 earlier nightly runs on this machine that passed, "
                              "and so far there is 1"),
            remarks.end());
}

TEST(ForeignNightlyRuns, EverySeriesThatGotWorseIsNamed) {
  const NightlyRun nightly_run =
      second_nightly_run({}, {.factor = [](const SeriesId& series, int run) {
                           return series.quantity == "ate_m" ? 1.2 + 0.001 * run : 1.0;
                         }});
  EXPECT_EQ(nightly_run.findings.size(), 12U);
  for (const NightlyFinding& finding : nightly_run.findings) {
    EXPECT_EQ(finding.sentence.find("last step"), std::string::npos) << finding.sentence;
    EXPECT_EQ(finding.sentence.find("layout"), std::string::npos) << finding.sentence;
    EXPECT_NE(finding.sentence.find("; Student's t test over 6 groups, p"), std::string::npos)
        << finding.sentence;
  }
}

TEST(ForeignNightlyRuns, GroupsAreTheUnitsHoweverFew) {
  // One of three groups is worse by far: 6 of 18 runs, but one unit of three.
  const auto judged = [](int groups) {
    ForeignNightlyRun plan{.groups = groups};
    ForeignNightlyRun worse = plan;
    worse.factor = [](const SeriesId& series, int run) {
      return series.method == "gamma noise=0.1" && run % 3 == 0 ? 2.0 + 0.01 * run
                                                                : 1.0 + 0.0001 * run;
    };
    return second_nightly_run(plan, worse).findings.size();
  };
  EXPECT_EQ(judged(3), 0U);
}

/// The first sentence on results that got worse by a factor of each run.
std::string sentence_of(int groups, const std::function<double(int run)>& factor) {
  const NightlyRun nightly_run = second_nightly_run(
      {.groups = groups}, {.groups = groups, .factor = [&](const SeriesId& series, int run) {
                             return series.quantity == "ate_m" ? factor(run) : 1.0;
                           }});
  return nightly_run.findings.empty() ? "" : nightly_run.findings[0].sentence;
}

TEST(ForeignNightlyRuns, EqualChangesOfFewGroupsHaveNoPAndNoInterval) {
  EXPECT_EQ(sentence_of(5, [](int) { return 1.15; }),
            "indoors, alpha, noise 0.1: ATE 15.0\u00a0% higher than in nightly run 1 in each of 5 "
            "groups; median 0.219 → 0.252\u00a0m; the changes are equal, so that no p is given");
}

TEST(ForeignNightlyRuns, AnErrorThatWas0HasNoPercentage) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  NightlyRun last;
  for (int number = 1; number <= 2; ++number) {
    ForeignNightlyRun plan;
    plan.factor = [&](const SeriesId& series, int) {
      const bool is_it = series.method == "gamma noise=0.1" && series.quantity == "ate_m";
      return !is_it ? 1.0 : number == 1 ? 0.0 : 0.02;
    };
    last = nightly_of(number, plan);
    judge_nightly_run(store, last, std::nullopt);
    store.append(last);
  }
  ASSERT_EQ(last.findings.size(), 1U);
  const NightlyFinding& one = last.findings[0];
  EXPECT_TRUE(
      one.sentence.starts_with("indoors, gamma, noise 0.1: ATE higher than in nightly run 1 in "
                               "each of 6 groups; median 0 → "))
      << one.sentence;
  EXPECT_EQ(one.sentence.find('%'), std::string::npos) << one.sentence;
  EXPECT_EQ(one.change, std::nullopt);
}

TEST(ForeignNightlyRuns, AMetricThatWas0HasNoPercentage) {
  NightlyRun nightly_run = nightly_of(1);
  const Quantities& quantities = nightly_run.studies[0].quantities;
  const Quantity& ate = quantities.at("ate_m");
  const double zero = level_of(ate, {{"a", "a", 0.0}, {"b", "b", 0.0}, {"c", "c", 0.0}});
  const double worsening = level_of(ate, {{"a", "a", 0.004}}) - zero;
  EXPECT_EQ(worse_words(ate, zero, worsening), "0.00400\u00a0m higher");
  EXPECT_EQ(change_of(ate, zero, worsening), std::nullopt);
  EXPECT_EQ(worse_words(ate, std::log(0.1), std::log(1.2)), "20.0\u00a0% higher");
  EXPECT_NEAR(change_of(ate, std::log(0.1), std::log(1.2)).value(), 20.0, 1e-9);
  const Quantity& found = quantities.at("found");
  EXPECT_EQ(worse_words(found, 0.0, 2.0), "2.00\u00a0points lower") << "a level of 0 points";
}

TEST(ForeignNightlyRuns, AnIntervalIsNotFromAValueToTheSame) {
  // Groups from 14.96 to 15.06 %: they differ in the digits shown, their mean is known to less.
  const std::string narrow =
      sentence_of(9, [](int run) { return run % 9 == 0 ? 1.1506 : 1.1496 + 0.00001 * (run % 9); });
  EXPECT_NE(narrow.find(", 95\u00a0% interval narrower than 0.1\u00a0%; "), std::string::npos)
      << narrow;
  const std::string wide = sentence_of(5, [](int run) { return 1.1 + 0.001 * (run % 5); });
  EXPECT_NE(wide.find(", 95\u00a0% interval 10.0 to 10.4\u00a0%; "), std::string::npos) << wide;
}

TEST(ForeignNightlyRuns, FewGroupsAreReportedByOneRuleAlone) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  for (int number = 1; number <= 6; ++number) {
    ForeignNightlyRun plan{.groups = 5, .step = 20};
    if (number >= 5)
      plan.factor = [](const SeriesId& series, int run) {
        const bool is_it = series.method == "gamma noise=0.1" && series.quantity == "ate_m";
        return is_it ? 1.15 + 0.001 * run : 1.0;
      };
    NightlyRun nightly_run = nightly_of(number, plan);
    judge_nightly_run(store, nightly_run, std::nullopt);
    store.append(nightly_run);
    EXPECT_EQ(reported(nightly_run),
              number < 5
                  ? std::vector<std::string>{}
                  : std::vector<std::string>{"accuracy: indoors, gamma noise=0.1, 20 steps: ate_m"})
        << number;
  }
}

TEST(ForeignNightlyRuns, FindingsAndRemarksHaveTheLabelsOfTheStudyAndKeepItsIds) {
  const StudyLabels labels{
      .setups = {{"indoors", "In the hall"}},
      .methods = {{"alpha", "Odometry"}, {"scan matching", "My ICP, faster"}, {"gamma", "gamma"}}};
  const NightlyRun worse = second_nightly_run(
      {.labels = labels}, {.factor =
                               [](const SeriesId& series, int run) {
                                 const bool is_it = series.method == "scan matching noise=0.4";
                                 return is_it && series.quantity == "ate_m" ? 1.2 + 0.001 * run
                                                                            : 1.0;
                               },
                           .labels = labels});
  ASSERT_EQ(worse.findings.size(), 1U);
  EXPECT_EQ(worse.findings[0].subject, "indoors, scan matching noise=0.4");
  EXPECT_TRUE(
      worse.findings[0].sentence.starts_with("In the hall, My ICP, faster, noise 0.4: ATE "))
      << worse.findings[0].sentence;

  ForeignNightlyRun gone{.labels = labels};
  gone.labels.methods.erase("scan matching");
  gone.is_there = [](const SeriesId& series, int) {
    return !series.method.starts_with("scan matching");
  };
  const NightlyRun lost = second_nightly_run({.labels = labels}, gone);
  ASSERT_EQ(lost.findings.size(), 1U);
  EXPECT_EQ(lost.findings[0].subject, "indoors, scan matching");
  EXPECT_TRUE(lost.findings[0].sentence.starts_with("In the hall, My ICP, faster: no result"))
      << lost.findings[0].sentence;

  const NightlyRun elsewhere =
      second_nightly_run({.labels = labels}, {.setup = "outdoors", .labels = labels});
  ASSERT_EQ(elsewhere.findings.size(), 1U);
  EXPECT_TRUE(elsewhere.findings[0].sentence.starts_with("In the hall: no result any more"))
      << elsewhere.findings[0].sentence;
}

TEST(ForeignNightlyRuns, OfATopicHaveTheLabelsOfItsDesign) {
  const NightlyStudy nightly_run =
      read_nightly_study(std::filesystem::path(MAPPROOF_TEST_DATA) / "topic_study", "topic");
  EXPECT_EQ(nightly_run.labels.setups.at("visibility"), "Ellipses of maps from visibility");
  EXPECT_EQ(nightly_run.labels.methods.at("isomap"), "ISOMAP, K = 8");
  EXPECT_TRUE(read_nightly_study(std::filesystem::path(MAPPROOF_TEST_DATA) / "study", "ours")
                  .labels.methods.empty());
}

TEST(ForeignNightlyRuns, TablesHaveNoStepsThatTheStudyHasNot) {
  StudyTrend trend{.name = "mine"};
  const NightlyRun nightly_run = nightly_of(1);
  add_this_run(trend, nightly_run.facts, nightly_run.studies[0]);
  EXPECT_EQ(accuracy_table(trend).caption, "Medians over the runs.");
}

}  // namespace
}  // namespace mapproof::test
