#include "reports/history/nightly_summary.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "reports/history/nightly_standing.hpp"
#include "reports/history/pages/history_pages.hpp"
#include "reports/history/pages/history_tables.hpp"
#include "reports/history/pages/study_course.hpp"
#include "reports/history/pages/trend_figures.hpp"

namespace mapproof::test {
namespace {

/// A trend of two settings of ISOMAP that got worse in nightly run 2, with commits.
StudyTrend two_settings() {
  StudyTrend trend{.name = "mine"};
  for (int number = 1; number <= 3; ++number)
    trend.nightly_runs.push_back(
        {.number = number,
         .started_utc = "2026-11-22T02:30:07Z",
         .utc_offset_s = 3600,
         .ended_utc = "2026-11-22T02:31:00Z",
         .command = "mapproof nightly mine --store 'my history'",
         .commit = number == 1 ? std::string(40, 'a') : std::string(40, 'b'),
         .repository = "https://github.com/me/x",
         .build = "make -j4",
         .reference = 1});
  trend.medians[{"bearing", "isomap-K6", 150, "mpe_m"}] = {0.10, 0.12, 0.12};
  trend.medians[{"bearing", "isomap-K8", 150, "mpe_m"}] = {0.10, 0.12, 0.12};
  trend.medians[{"bearing", "lpca", 150, "mpe_m"}] = {0.20, 0.20, 0.20};
  return trend;
}

std::vector<NightlyFinding> two_findings() {
  NightlyFinding finding{.study = "mine",
                         .subject = "bearing, isomap-K6, 150 steps",
                         .quantity = "mpe_m",
                         .since = 2,
                         .sentence = "with <b>numbers</b>",
                         .change = 17.6};
  NightlyFinding other = finding;
  other.subject = "bearing, isomap-K8, 150 steps";
  return {finding, other};
}

NightlySummary summary_of(const std::vector<NightlyNote>& notes = {}) {
  const StudyTrend trend = two_settings();
  const std::vector<NightlyFinding> findings = two_findings();
  return last_summary({.nightly_runs = trend.nightly_runs,
                       .findings = {{3, findings}},
                       .trends = {trend},
                       .notes = notes});
}

NightlyNote known(int finding, const std::string& text) {
  NightlyNote note{.nightly_run = 3, .finding = finding, .kind = NoteKind::kKnown, .text = text};
  put_finding(note, two_findings()[static_cast<std::size_t>(finding - 1)]);
  return note;
}

TEST(FindingGroups, AreOfOneMethodAndSayWhatChangedByHowMuchAndSinceWhichCommits) {
  const NightlySummary summary = summary_of();
  ASSERT_EQ(summary.groups.size(), 1U);
  const FindingGroup& group = summary.groups[0];
  EXPECT_EQ(group.headline(), "ISOMAP: MPE +20.0\u00a0% (K = 6 and 8)");
  EXPECT_EQ(group.commits.text(), "aaaaaaaaa..bbbbbbbbb");
  EXPECT_EQ(group.commits.url(), "https://github.com/me/x/compare/" + std::string(40, 'a') + "..." +
                                     std::string(40, 'b'));
  EXPECT_EQ(group.commits.bisect(),
            "git bisect start bbbbbbbbb aaaaaaaaa && git bisect run sh -c '(make -j4) || exit 125; "
            "mapproof nightly mine --store '\\''my history'\\'' --bisect 2'");
  EXPECT_EQ(summary.short_verdict(), "MPE +20.0\u00a0%");
  EXPECT_EQ(group.count_text(), "2 findings");
}

TEST(FindingGroups, OfWhatGotWorseMostStandFirstAccuracyBeforeCosts) {
  StudyTrend trend = two_settings();
  trend.medians[{"bearing", "lpca", 150, "mpe_m"}] = {0.20, 0.20, 0.30};
  std::vector<NightlyFinding> findings = two_findings();
  NightlyFinding lpca = findings[0], memory = findings[0];
  lpca.subject = "bearing, lpca, 150 steps";
  lpca.change = 50.0;
  memory.rule = HistoryRule::kMemory;
  memory.subject = kAllMethods;
  memory.quantity = "memory";
  memory.change = 90.0;
  findings.insert(findings.begin(), memory);
  findings.push_back(lpca);
  const IndexFacts facts{
      .nightly_runs = trend.nightly_runs, .findings = {{3, findings}}, .trends = {trend}};
  const std::vector<FindingGroup> groups = last_summary(facts).groups;
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[0].headline(), "LPCA: MPE +50.0\u00a0%");
  EXPECT_EQ(groups[1].headline(), "ISOMAP: MPE +20.0\u00a0% (K = 6 and 8)");
  EXPECT_EQ(groups[2].rule, HistoryRule::kMemory);
  const Report index = index_page(facts, {}).report;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    EXPECT_EQ(std::get<FindingBlock>(index.sections.front().blocks[i]).title, groups[i].headline());
    EXPECT_NE(index.opening.standing->sentences[i].find(groups[i].headline()), std::string::npos);
  }
  EXPECT_TRUE(trend_figures(trend, facts.findings)
                  .front()
                  .title.starts_with("Bearing: LPCA: MPE +50.0\u00a0% and ISOMAP: MPE"));
}

TEST(FindingGroups, OfAllSettingsOfAMethodSaySoInsteadOfNamingEach) {
  StudyTrend trend = two_settings();
  trend.medians[{"bearing", "isomap-K10", 150, "mpe_m"}] = {0.10, 0.12, 0.12};
  std::vector<NightlyFinding> findings = two_findings();
  findings.push_back(findings.front());
  findings.back().subject = "bearing, isomap-K10, 150 steps";
  const auto headline = [&] {
    return grouped(3, findings, std::span(&trend, 1), {}).at(0).headline();
  };
  EXPECT_EQ(headline(), "ISOMAP: MPE +20.0\u00a0% (all 3 settings)");
  trend.medians[{"range", "isomap-K12", 150, "mpe_m"}] = {0.10, 0.10, 0.10};
  EXPECT_EQ(headline(), "ISOMAP: MPE +20.0\u00a0% (all 3 settings)") << "of this setup";
  trend.medians[{"bearing", "isomap-K12", 150, "mpe_m"}] = {0.10, 0.10, 0.10};
  EXPECT_EQ(headline(), "ISOMAP: MPE +20.0\u00a0% (K = 6, 8 and 10)");
}

TEST(FindingGroups, OfAnotherProgramJoinMethodsWhoseNamesDifferInTheirLastNumberAlone) {
  StudyTrend trend = two_settings();
  trend.labels.setups = {{"bearing", "Hall"}};
  trend.labels.methods = {{"isomap-K6", "isomap-K6"}, {"isomap-K8", "isomap-K8"}, {"lpca", "lpca"}};
  std::vector<NightlyFinding> findings = two_findings();
  findings.push_back(findings.front());
  findings.back().subject = "bearing, lpca, 150 steps";
  const NightlySummary summary = last_summary(
      {.nightly_runs = trend.nightly_runs, .findings = {{3, findings}}, .trends = {trend}});
  ASSERT_EQ(summary.groups.size(), 2U);
  EXPECT_EQ(summary.groups[0].headline(), "isomap-K6 and isomap-K8: MPE +20.0\u00a0%");
  EXPECT_EQ(summary.groups[0].count_text(), "2 findings");
  // Its medians, those of the trend, are equal.
  EXPECT_EQ(summary.groups[1].headline(),
            "lpca: MPE got worse in pairs of runs, its median unchanged");
}

TEST(FindingGroups, SearchWithACommandThatNamesNoCommitAndWritesNothing) {
  CommitRange range{
      .before = {.number = 1, .commit = std::string(40, 'a')},
      .since = {.number = 2,
                .command = "mapproof nightly 'a b.json' --build 'make -j4' --commit " +
                           std::string(40, 'b') +
                           " --store h --reference=1 --on-worse 'echo \"it'\\''s\"' "
                           "-o pages --markdown n.md --junit n.xml --jobs 2",
                .commit = std::string(40, 'b'),
                .build = "make -j4"}};
  EXPECT_EQ(range.bisect(),
            "git bisect start bbbbbbbbb aaaaaaaaa && git bisect run sh -c '(make -j4) || exit 125; "
            "mapproof nightly '\\''a b.json'\\'' --store h --jobs 2 --bisect 2'");
}

TEST(FindingGroups, SayInWordsWhichFoldersOfTheSearchAreNotShown) {
  CommitRange range = summary_of().groups[0].commits;
  range.since.build = "make";
  range.since.command = "mapproof nightly …/results --store '…/a store' --jobs 2";
  EXPECT_EQ(range.bisect_gaps(),
            "Put the path of the folder, which is not shown, in place of each ….");
  range.since.build.clear();
  EXPECT_NE(range.bisect_gaps().find("in place of BUILD"), std::string::npos);
  EXPECT_NE(range.bisect_gaps().find("in place of each …"), std::string::npos);
  range.since.command = "mapproof nightly results --store \"store\"";
  EXPECT_EQ(range.bisect_gaps().find("…"), std::string::npos);
}

TEST(FindingGroups, SayInWordsWhatStandsForBuild) {
  CommitRange range = summary_of().groups[0].commits;
  EXPECT_EQ(range.bisect_gaps(), "");
  range.since.build.clear();
  EXPECT_NE(range.bisect().find("'(BUILD) || exit 125; "), std::string::npos);
  EXPECT_NE(range.bisect_gaps().find("in place of BUILD"), std::string::npos);
  range.before.commit.clear();
  EXPECT_EQ(range.bisect_gaps(), "") << "there is no command";
}

TEST(FindingGroups, SayBetweenWhichNightlyRunsTheyBegan) {
  CommitRange range{.before = {.number = 1, .started_utc = "2026-11-20T02:30:07Z"},
                    .since = {.number = 2, .started_utc = "2026-11-21T02:30:07Z"}};
  EXPECT_EQ(range.words(), "between nightly runs 1 and 2");
  EXPECT_EQ(range.dated_words(),
            "between nightly runs 1 (2026-11-20 02:30 UTC) and 2 (2026-11-21 02:30 UTC)");
  range.before = {};
  EXPECT_EQ(range.words(), "since nightly run 2");
  EXPECT_EQ(range.dated_words(), "since nightly run 2 (2026-11-21 02:30 UTC)");
}

TEST(FindingGroups, OfOneFindingHaveItsValuesInTheReferenceRunAndThisOne) {
  StudyTrend trend = two_settings();
  trend.medians[{"bearing", "isomap-K6", 50, "mpe_m"}] = {0.50, 0.60, 0.60};
  std::vector<NightlyFinding> findings = {two_findings()[0]};
  const auto group = [&] { return grouped(3, findings, std::span(&trend, 1), {}).at(0); };
  EXPECT_EQ(group().values_text(), "median 0.100 → 0.120\u00a0m");
  EXPECT_EQ(summary_of().groups[0].values_text(), "") << "of two settings";
  findings[0].subject = "bearing, isomap-K6, mean of 2 steps";
  EXPECT_EQ(group().values_text(), "") << "the medians are of the last step";
  findings[0].subject = "bearing, isomap-K6, 150 steps";
  trend.nightly_runs.back().reference.reset();
  EXPECT_EQ(group().values_text(), "") << "it was not compared";
}

TEST(FindingGroups, StateTheChangeOfTheMedianAsFiguresAndTablesDo) {
  StudyTrend trend = two_settings();
  std::vector<NightlyFinding> findings = {two_findings()[0]};
  const auto change = [&] {
    return grouped(3, findings, std::span(&trend, 1), {}).at(0).change_text();
  };
  EXPECT_EQ(change(), "MPE +20.0\u00a0%") << "not the 17.6 % of the paired test";
  const Figure figure = trend_figures(trend, {{3, findings}}).front();
  EXPECT_EQ(figure.title, "Bearing: ISOMAP: MPE +20.0\u00a0%");
  std::vector<double> drawn;
  for (const Layer& layer : figure.panels.at(0).layers)
    if (const auto* line = std::get_if<Polyline>(&layer); line && line->label == "ISOMAP, K = 6")
      drawn = line->y;
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_NEAR(drawn.back(), 20.0, 1e-9);
  EXPECT_NEAR(worst_course(trend, {{3, findings}}, {})->curve.changes.back(), 20.0, 1e-9);

  trend.medians[{"bearing", "isomap-K6", 150, "mpe_m"}] = {0.10, 0.12, 0.099};
  EXPECT_EQ(change(), "MPE got worse in pairs of runs, its median −1.0\u00a0%");
  findings[0].subject = "bearing, isomap-K6, mean of 2 steps";
  EXPECT_EQ(change(), "MPE over all steps +17.6\u00a0%");
}

TEST(FindingGroups, SayThatAMapDivergedInPlaceOfItsError) {
  StudyTrend trend = two_settings();
  std::vector<NightlyFinding> findings = {two_findings()[0]};
  const auto values = [&](double before, double after) {
    trend.medians[{"bearing", "isomap-K6", 150, "mpe_m"}] = {before, before, after};
    return grouped(3, findings, std::span(&trend, 1), {}).at(0).values_text();
  };
  EXPECT_EQ(values(1e6, 1.3e6), "median over 1\u00a0km before and after (1.30 times as great)");
  EXPECT_EQ(values(0.1, 1.3e6), "median 0.100\u00a0m → over 1\u00a0km");

  trend.quantities.declare(study_quantity("drift_m", "drift", "m", Better::kLower));
  findings[0].quantity = "drift_m";
  trend.medians[{"bearing", "isomap-K6", 150, "drift_m"}] = {2e3, 2e3, 4e3};
  EXPECT_EQ(values(0.1, 0.1), "median 2000 → 4000\u00a0m") << "distances of that size";
  trend.medians[{"bearing", "lpca", 150, "drift_m"}] = {0.1, 0.1, 0.1};
  EXPECT_EQ(values(0.1, 0.1), "median over 1\u00a0km before and after (2.00 times as great)");
}

TEST(FindingGroups, OfAnErrorThatWas0HaveItsValuesForAPercentageAndComeAfterThose) {
  StudyTrend trend = two_settings();
  trend.medians[{"bearing", "isomap-K6", 150, "mpe_m"}] = {0.0, 0.0, 0.004};
  trend.medians[{"bearing", "isomap-K8", 150, "mpe_m"}] = {0.0, 0.0, 0.004};
  trend.medians[{"bearing", "lpca", 150, "mpe_m"}] = {0.20, 0.20, 0.21};
  std::vector<NightlyFinding> findings = two_findings();
  findings[0].change = 399999900.0;  // As older histories have it.
  findings[1].change.reset();
  findings.push_back(findings[1]);
  findings[2].subject = "bearing, lpca, 150 steps";
  const auto groups = [&] { return grouped(3, findings, std::span(&trend, 1), {}); };
  ASSERT_EQ(groups().size(), 2U);
  EXPECT_EQ(groups()[0].headline(), "LPCA: MPE +5.0\u00a0%");
  EXPECT_EQ(groups()[1].headline(), "ISOMAP: MPE from 0 to 0.00400\u00a0m (K = 6 and 8)");
  trend.medians[{"bearing", "isomap-K8", 150, "mpe_m"}].back() = 0.005;
  EXPECT_EQ(groups()[1].change_text(), "MPE from 0 to between 0.00400\u00a0m and 0.00500\u00a0m");
  findings.erase(findings.begin());
  EXPECT_EQ(groups()[1].values_text(), "") << "the headline has them";
}

TEST(HistoryPages, NameInANoteWhatStartedAt0AndDrawItsValuesWhereThereIsNothingElse) {
  StudyTrend trend = two_settings();
  trend.medians[{"bearing", "lpca", 150, "mpe_m"}] = {0.0, 0.0, 0.004};
  std::vector<NightlyFinding> findings = {two_findings()[0]};
  findings[0].subject = "bearing, lpca, 150 steps";
  const auto figure = [&] { return trend_figures(trend, {{3, findings}}).front(); };
  const auto labels = [](const Figure& one) {
    std::vector<std::string> all;
    for (const Layer& layer : one.panels.at(0).layers)
      if (std::holds_alternative<Polyline>(layer)) all.push_back(label_of(layer));
    return all;
  };
  ASSERT_EQ(figure().notes.size(), 1U);
  EXPECT_EQ(figure().notes[0].text, "Started at 0, so that changes have no percentage: LPCA.");
  EXPECT_EQ(labels(figure()), std::vector<std::string>{"ISOMAP, K = 6"});
  EXPECT_EQ(figure().alt.find("nothing known"), std::string::npos) << figure().alt;

  std::erase_if(trend.medians, [](const auto& of) { return of.first.method != "lpca"; });
  EXPECT_EQ(figure().title, "Bearing: LPCA: MPE from 0 to 0.00400\u00a0m");
  EXPECT_TRUE(figure().notes.empty());
  EXPECT_EQ(figure().panels.at(0).y.label, "MPE [m]");
  EXPECT_EQ(labels(figure()), std::vector<std::string>{"LPCA"});
}

TEST(FindingGroups, AreShownAgainstTheNightlyRunBeforeTheyBegan) {
  StudyTrend trend = two_settings();
  trend.nightly_runs.back().reference = 2;
  trend.medians[{"bearing", "isomap-K6", 150, "mpe_m"}] = {0.10, 0.11, 0.12};
  const std::vector<NightlyFinding> findings = {two_findings()[0]};  // Since nightly run 2.
  const FindingGroup group = grouped(3, findings, std::span(&trend, 1), {}).at(0);
  EXPECT_EQ(group.values_text(), "median 0.100 → 0.120\u00a0m");
  EXPECT_EQ(std::get<NumberCell>(accuracy_table(trend, findings).rows[0].cells[4]).value, 0.10);
}

TEST(FindingGroups, KnowTheStoreOfACommand) {
  EXPECT_EQ(store_word("mapproof nightly mine --store 'my history' --jobs 2"), "'my history'");
  EXPECT_EQ(store_word("mapproof nightly mine --store=h"), "h");
  EXPECT_EQ(store_word("mapproof nightly mine"), "STORE");
}

TEST(FindingGroups, SayTheTimeByTheClockOfThePlace) {
  const NightlyFacts facts{.started_utc = "2026-11-22T23:30:07Z"};
  EXPECT_EQ(local_time(facts), "2026-11-22 23:30 UTC");
  NightlyFacts east = facts;
  east.utc_offset_s = 5 * 3600 + 1800;
  EXPECT_EQ(local_time(east), "2026-11-23 05:00 +05:30");
  NightlyFacts west = facts;
  west.utc_offset_s = -3600;
  EXPECT_EQ(local_time(west), "2026-11-22 22:30 −01:00");
  EXPECT_EQ(local_time({.started_utc = "yesterday"}), "yesterday");
}

TEST(FindingGroups, LinkToPlainAddressesAlone) {
  EXPECT_EQ(commit_url("https://github.com/me/x", "abc"), "https://github.com/me/x/commit/abc");
  EXPECT_EQ(commit_url("javascript:alert(1)//", "abc"), "");
  EXPECT_EQ(commit_url("", "abc"), "");
}

TEST(NightlySummary, CountsWhatIsKnownApart) {
  const NightlySummary one = summary_of({known(1, "sensor")});
  EXPECT_EQ(one.new_findings(), 1U);
  EXPECT_EQ(one.groups.size(), 2U);
  EXPECT_FALSE(one.groups[0].known.has_value()) << "what is new goes first";
  EXPECT_EQ(one.verdict(), NightlyVerdict::kAccuracy);
  const NightlySummary all = summary_of({known(1, "sensor"), known(2, "sensor")});
  EXPECT_EQ(all.new_findings(), 0U);
  EXPECT_EQ(all.groups.size(), 1U);
  EXPECT_EQ(all.verdict(), NightlyVerdict::kPassed);
  EXPECT_EQ(all.short_verdict(), "passed");
  EXPECT_EQ(all.title(),
            "Nightly run 3: nothing new got worse since nightly run 1; accuracy is worse as known: "
            "2 findings");
}

TEST(NightlySummary, SaysWhatIsNewByItsKindAndWhatIsKnownAsKnown) {
  NightlySummary summary = summary_of({known(1, "sensor"), known(2, "sensor")});
  FindingGroup seconds{.study = "mine", .rule = HistoryRule::kSeconds, .quantity_id = "seconds"};
  seconds.numbers = {3};
  summary.groups.insert(summary.groups.begin(), seconds);
  EXPECT_EQ(summary.title(),
            "Nightly run 3: time grew: 1 finding; accuracy is worse as known: 2 findings");
  EXPECT_EQ(verdict_sentence(summary.facts, summary.groups),
            "Time grew: 1 finding; accuracy is worse as known: 2 findings.");
  EXPECT_TRUE(nightly_markdown(summary).starts_with("### " + summary.title()));
  EXPECT_NE(nightly_junit(summary).find("<testsuites name=\"" + summary.title() + "\""),
            std::string::npos);
  NightlyLinks links({});
  EXPECT_EQ(study_standing(summary.facts, summary.groups, "mine", true, links).title,
            summary.title());

  FindingGroup memory{.study = "mine", .rule = HistoryRule::kCostDrift, .quantity_id = "memory"};
  FindingGroup lost{.study = "mine", .rule = HistoryRule::kLostResults, .quantity_id = "mpe_m"};
  memory.numbers = {4};
  lost.numbers = {5};
  EXPECT_EQ(verdict_sentence(summary.facts, std::vector{lost, seconds, memory}),
            "Results are lost, time grew and memory grew: 3 findings.");
}

TEST(NightlySummary, AsMarkdownHasCommitsTheSearchAndNothingActive) {
  NightlySummary summary = summary_of({known(1, "<img src=x onerror=alert(1)> [a](javascript:b)")});
  summary.remarks = {"a | b"};
  const std::string text = nightly_markdown(summary);
  EXPECT_NE(text.find("[`aaaaaaaaa..bbbbbbbbb`](https://github.com/me/x/compare/"),
            std::string::npos);
  EXPECT_NE(text.find("git bisect start"), std::string::npos);
  EXPECT_EQ(text.find("<img"), std::string::npos);
  EXPECT_EQ(text.find("](javascript"), std::string::npos);
}

TEST(NightlySummary, AsJunitFailsWhatIsNewAndSkipsWhatIsKnown) {
  const std::string fails = nightly_junit(summary_of());
  EXPECT_NE(fails.find("tests=\"3\" failures=\"2\" skipped=\"0\""), std::string::npos) << fails;
  EXPECT_NE(fails.find("with &lt;b&gt;numbers"), std::string::npos);
  const std::string skips = nightly_junit(summary_of({known(1, "\"quoted\" <x>")}));
  EXPECT_NE(skips.find("failures=\"1\" skipped=\"1\""), std::string::npos) << skips;
  EXPECT_EQ(skips.find("<x>"), std::string::npos);
}

TEST(NightlySummary, AsBadgeIsAnSvgWithTextAlone) {
  NightlySummary summary = summary_of();
  summary.groups[0].quantity = "<script>alert(1)</script>";
  const std::string badge = nightly_badge(summary);
  EXPECT_EQ(badge.find("<script"), std::string::npos);
  EXPECT_NE(badge.find("&lt;script"), std::string::npos);
  const auto json = nlohmann::json::parse(nightly_badge_json(summary_of()));
  EXPECT_EQ(json["schemaVersion"], 1);
  EXPECT_EQ(json["message"], "MPE +20.0 %");
}

TEST(NightlyFeed, HasAnEntryPerNightlyRunWhoseIdentifierStays) {
  const NightlySummary first = summary_of();
  NightlySummary second = summary_of();
  second.facts.number = 2;
  const std::string identifier = "urn:uuid:00000000-0000-4000-a000-000000000000";
  const std::string feed = nightly_feed({identifier, {first, second}, "../my store/"});
  EXPECT_NE(feed.find("href=\"../my%20store/nightly_runs/0003/\""), std::string::npos);
  EXPECT_NE(feed.find("<updated>2026-11-22T02:31:00Z</updated>"), std::string::npos);
  const std::size_t id = feed.find("<id>urn:uuid:", feed.find("<entry>"));
  ASSERT_NE(id, std::string::npos);
  const std::string entry = feed.substr(id, 60);
  EXPECT_NE(nightly_feed({identifier, {second, first}}).find(entry), std::string::npos);
  EXPECT_EQ(feed.find(entry, id + 1), std::string::npos);
  EXPECT_EQ(feed.find("<b>"), std::string::npos);
}

TEST(HistoryPages, BeginWithWhatGotWorseWhereItBeganAndALinePerStudy) {
  const StudyTrend trend = two_settings();
  const HistoryPage index =
      index_page({.nightly_runs = trend.nightly_runs,
                  .findings = {{3, two_findings()}},
                  .trends = {trend},
                  .notes = {{.nightly_run = 3, .text = "a note"},
                            {.nightly_run = 3, .finding = 2, .text = "of K = 8"}},
                  .comparisons = {comparison_file(1, 2, "mine")}},
                 {});
  EXPECT_NO_THROW(check(index.report));
  EXPECT_EQ(
      index.report.opening.standing->sentences.front(),
      "mine: bearing, ISOMAP: MPE +20.0\u00a0% (K = 6 and 8) (both findings), between nightly "
      "runs 1 and 2: git log aaaaaaaaa..bbbbbbbbb.");
  EXPECT_EQ(index.report.opening.standing->title, "Nightly run 3: accuracy got worse: 2 findings");
  ASSERT_EQ(index.report.sections.front().id, "worse");
  const auto& found = std::get<FindingBlock>(index.report.sections.front().blocks.front());
  EXPECT_EQ(found.keys, "3.1 3.2");
  EXPECT_EQ(found.details.size(), 2U) << "statistics are behind a click";
  EXPECT_EQ(std::prev(found.text.phrases.end(), 2)->text, " Note on 3.2: ");
  EXPECT_EQ(found.text.phrases.back().text, "of K = 8");
  const auto callouts = std::ranges::count_if(
      index.report.sections.at(1).blocks,
      [](const Block& block) { return std::holds_alternative<Callout>(block); });
  EXPECT_EQ(callouts, 1) << "a note on a finding stands with it";
  const auto& comparing = std::get<Paragraph>(index.report.sections.back().blocks.back());
  EXPECT_EQ(comparing.phrases.at(1).text, "mapproof history 'my history' --compare 2 3");
  EXPECT_TRUE(index.link_words.contains("compare/0001-0002/mine.html"));
  const std::vector<Phrase>& cause = index.report.opening.findings.at(1).phrases;
  ASSERT_EQ(cause.size(), 5U) << "one diff of both findings";
  EXPECT_EQ(cause[0].text, "What changed");
  EXPECT_EQ(cause[2].text, "compare/0001-0002/mine.html");
  EXPECT_TRUE(cause[4].text.starts_with("git bisect start "));
  const Table* studies = tables(index.report).front();
  ASSERT_EQ(studies->id, "studies");
  ASSERT_EQ(studies->rows.size(), 1U);
  EXPECT_EQ(std::get<TextCell>(studies->rows[0].cells[1]).text,
            "bearing, ISOMAP: MPE +20.0\u00a0% (K = 6 and 8)");
  EXPECT_EQ(std::get<TextCell>(studies->rows[0].cells[2]).text, "none");
  ASSERT_EQ(studies->rows[0].curves.size(), 1U);
  const ChangeCurve& curve = studies->rows[0].curves[0];
  EXPECT_EQ(curve.cell, 1U);
  EXPECT_NEAR(curve.changes.back(), 20.0, 1e-9);
  EXPECT_EQ(curve.is_found, (std::vector<bool>{false, false, true}));
}

TEST(HistoryPages, ShowWhatIsNewOnTheFirstScreenBeforeWhatIsKnown) {
  StudyTrend trend = two_settings();
  trend.peak_memory_mib = {100.0, 100.0, 112.0};
  trend.medians[{"bearing", "lpca", 150, "seconds"}] = {1.0, 1.0, 1.5};
  std::vector<NightlyFinding> findings = two_findings();
  findings.push_back({.study = "mine",
                      .rule = HistoryRule::kSeconds,
                      .subject = "bearing, lpca",
                      .quantity = "seconds",
                      .since = 3,
                      .change = 50.0});
  findings.push_back({.study = "mine",
                      .rule = HistoryRule::kMemory,
                      .subject = kAllMethods,
                      .quantity = "memory",
                      .since = 3,
                      .change = 12.0});
  StudyTrend other = trend;
  other.name = "another";
  NightlyFinding of_other = findings[0];
  of_other.study = "another";
  const auto figures = [&](const std::vector<NightlyFinding>& found,
                           const std::vector<StudyTrend>& trends) {
    const HistoryPage index = index_page({.nightly_runs = trend.nightly_runs,
                                          .findings = {{3, found}},
                                          .trends = trends,
                                          .notes = {known(1, "sensor"), known(2, "sensor")}},
                                         {});
    std::vector<std::string> ids = {index.report.opening.main_figure};
    const std::vector<std::string>& small = index.report.opening.figure_ids;
    ids.insert(ids.end(), small.begin(), small.end());
    return ids;
  };
  EXPECT_EQ(figures(findings, {trend}),
            (std::vector<std::string>{"trend-seconds-bearing", "trend-memory"}));
  EXPECT_EQ(figures({findings[0], findings[1], of_other}, {trend, other}),
            (std::vector<std::string>{"trend-another-mpe-m-bearing", "trend-mine-mpe-m-bearing"}));
  const HistoryPage page =
      trend_page(trend, {{3, findings}}, true, {}, std::vector{known(1, "a"), known(2, "a")});
  EXPECT_EQ(page.report.opening.main_figure, "trend-seconds-bearing");
  ASSERT_EQ(page.figures.size(), 3U);
  EXPECT_EQ(page.figures.back().title, "Bearing: ISOMAP: MPE +20.0\u00a0% (known)");
}

TEST(HistoryPages, ShowWhatGotSlowerBeforeValuesThatDidNotChange) {
  StudyTrend trend = two_settings();
  for (auto& [id, values] : trend.medians) values = {0.1, 0.1, 0.1};
  trend.medians[{"bearing", "lpca", 150, "seconds"}] = {1.0, 1.0, 1.5};
  const NightlyFindings findings = {{3,
                                     {{.study = "mine",
                                       .rule = HistoryRule::kSeconds,
                                       .subject = "bearing, lpca",
                                       .quantity = "seconds",
                                       .since = 3,
                                       .change = 50.0}}}};
  const std::vector<Figure> figures = trend_figures(trend, findings);
  ASSERT_EQ(figures.size(), 2U);
  EXPECT_EQ(figures[0].id, "trend-seconds-bearing");
  EXPECT_EQ(figures[1].id, "trend-mpe-m-bearing-values");
  EXPECT_EQ(trend_figures(trend, {}).front().id, "trend-mpe-m-bearing-values");
}

TEST(HistoryPages, SayOnceBetweenWhichNightlyRunsSeveralFindingsBegan) {
  StudyTrend trend = two_settings();
  trend.medians[{"bearing", "lpca", 150, "mpe_m"}] = {0.20, 0.30, 0.30};
  trend.medians[{"bearing", "smacof", 150, "mpe_m"}] = {0.20, 0.20, 0.21};
  std::vector<NightlyFinding> findings = {two_findings()[0]};
  const auto add = [&](const std::string& method, int since) {
    findings.push_back(findings.front());
    findings.back().subject = "bearing, " + method + ", 150 steps";
    findings.back().since = since;
  };
  const auto standing = [&] {
    return index_page(
               {.nightly_runs = trend.nightly_runs, .findings = {{3, findings}}, .trends = {trend}},
               {})
        .report.opening.standing.value();
  };
  EXPECT_EQ(standing().note, "") << "a single finding names its nightly runs itself";
  add("lpca", 2);
  EXPECT_EQ(standing().note,
            "All of these got worse between nightly runs 1 and 2: git log aaaaaaaaa..bbbbbbbbb.");
  for (const std::string& sentence : standing().sentences)
    EXPECT_EQ(sentence.find("nightly run"), std::string::npos) << sentence;
  add("smacof", 3);
  EXPECT_EQ(standing().note,
            "The others got worse between nightly runs 1 and 2: git log aaaaaaaaa..bbbbbbbbb.");
  EXPECT_NE(standing().sentences.back().find(", between nightly runs 2 and 3."), std::string::npos)
      << standing().sentences.back();
}

TEST(HistoryPages, DoNotSayOfFindingsThatAreOnlyCountedThatTheyBeganWithThoseThatAreNamed) {
  std::vector<NightlyFinding> findings;
  for (int i = 1; i <= 5; ++i)
    findings.push_back({.study = "mine",
                        .subject = "method " + std::to_string(i),
                        .quantity = "mpe_m",
                        .since = i <= 2 ? 2 : 3,
                        .change = i});
  const auto note = [&] {
    NightlyLinks links({});
    const StudyTrend trend = two_settings();
    const std::vector<FindingGroup> groups = grouped(3, findings, std::span(&trend, 1), {});
    return study_standing({.number = 3}, groups, "mine", true, links).note;
  };
  EXPECT_EQ(note(), "These 3 got worse between nightly runs 2 and 3.");
  findings[4].since = 1;
  EXPECT_EQ(note(), "The others named here got worse between nightly runs 2 and 3.");
  findings[0].since = findings[1].since = 3;
  EXPECT_EQ(note(), "The others got worse between nightly runs 2 and 3.");
  findings[4].since = 3;
  EXPECT_EQ(note(), "All of these got worse between nightly runs 2 and 3.");
}

TEST(HistoryPages, ShowASearchOnTheFirstScreenOnlyWhereItCanBeRun) {
  StudyTrend trend = two_settings();
  for (NightlyFacts& nightly_run : trend.nightly_runs) nightly_run.build.clear();
  const HistoryPage index = index_page({.nightly_runs = trend.nightly_runs,
                                        .findings = {{3, {two_findings()[0]}}},
                                        .trends = {trend},
                                        .comparisons = {comparison_file(1, 2, "mine")}},
                                       {});
  EXPECT_EQ(
      index.report.opening.standing->sentences.front(),
      "mine: bearing, ISOMAP: MPE +20.0\u00a0% (K = 6) (median 0.100 → 0.120\u00a0m), between "
      "nightly runs 1 and 2: git log aaaaaaaaa..bbbbbbbbb.");
  EXPECT_EQ(index.report.opening.findings.at(1).phrases.size(), 3U) << "the diff alone";
  const auto& found = std::get<FindingBlock>(index.report.sections.front().blocks.front());
  EXPECT_NE(found.command.find("(BUILD)"), std::string::npos);
  EXPECT_NE(found.details.back().find("in place of BUILD"), std::string::npos);
}

TEST(HistoryPages, CompareTheValuesOfATrendWithTheRunBeforeItGotWorse) {
  const Table table = accuracy_table(two_settings(), two_findings());
  EXPECT_EQ(table.caption,
            "Medians over the runs at the last step of each method; before: nightly run 1.");
  ASSERT_EQ(table.rows.size(), 3U);
  const Row& worse = table.rows[0];
  EXPECT_EQ(std::get<NumberCell>(worse.cells[4]).value, 0.10);
  EXPECT_EQ(std::get<NumberCell>(worse.cells[5]).value, 0.12);
  EXPECT_EQ(worse.regressed, "MPE +20.0\u00a0%");
  EXPECT_EQ(table.rows[1].regressed, "MPE +20.0\u00a0%");
  EXPECT_EQ(table.rows[2].regressed, "") << "LPCA did not change";
}

TEST(StudyCourse, ShowsAnImprovementBesideAFindingThatItOutweighs) {
  StudyTrend trend = two_settings();
  for (const char* method : {"lem-K7", "lle-K8"})
    trend.medians[{"bearing", method, 150, "mpe_m"}] = {0.10, 0.07, 0.07};
  const NightlyFindings findings = {{3, two_findings()}};
  const auto worst = worst_course(trend, findings, {}), best = best_course(trend, findings);
  ASSERT_TRUE(worst && best);
  EXPECT_TRUE(worst->curve.is_found.back());
  EXPECT_GT(worst->curve.changes.back(), 0.0);
  EXPECT_TRUE(best->words.starts_with("bearing, LEM, K = 7: MPE −30.0") ||
              best->words.starts_with("bearing, LLE, K = 8: MPE −30.0"))
      << best->words;
  EXPECT_NEAR(best->curve.changes.back(), -30.0, 1e-9);
}

TEST(StudyCourse, IsThatOfTheFindingWhateverItIsAbout) {
  StudyTrend trend = two_settings();
  trend.peak_memory_mib = {100.0, 100.0, 112.0};
  trend.medians[{"bearing", "lpca", 150, "seconds"}] = {1.0, 1.0, 1.5};
  const NightlyFinding memory{.study = "mine",
                              .rule = HistoryRule::kMemory,
                              .subject = kAllMethods,
                              .quantity = "memory",
                              .since = 3,
                              .change = 12.0};
  const auto of_memory = worst_course(trend, {{3, {memory}}}, {});
  ASSERT_TRUE(of_memory);
  EXPECT_NEAR(of_memory->curve.changes.back(), 12.0, 1e-9);
  EXPECT_TRUE(of_memory->curve.is_found.back());
  NightlyFinding seconds = memory;
  seconds.rule = HistoryRule::kSeconds;
  seconds.subject = "bearing, lpca";
  seconds.quantity = "seconds";
  seconds.change = 50.0;
  const auto of_seconds = worst_course(trend, {{3, {memory, seconds}}}, {});
  ASSERT_TRUE(of_seconds);
  EXPECT_TRUE(of_seconds->words.ends_with("and 1 more finding")) << of_seconds->words;
  EXPECT_NEAR(of_seconds->curve.changes.back(), 50.0, 1e-9);
  NightlyFinding lost = seconds;
  lost.rule = HistoryRule::kLostResults;
  lost.change.reset();
  EXPECT_TRUE(worst_course(trend, {{3, {lost}}}, {})->words.find("results are lost") !=
              std::string::npos);
}

TEST(StudyCourse, OfAChangeThatIsNoFindingIsNotRed) {
  const auto course = worst_course(two_settings(), {}, {});
  ASSERT_TRUE(course);
  EXPECT_EQ(course->words, "bearing, ISOMAP, K = 8: MPE +20.0\u00a0%");
  EXPECT_EQ(course->curve.is_found, (std::vector<bool>{false, false, false}));
  EXPECT_FALSE(best_course(two_settings(), {}));
}

/// A trend of orientation errors, which are judged by points.
StudyTrend in_points(double last) {
  StudyTrend trend = two_settings();
  const SeriesId id{"bearing", "isomap-K6", 150, "moe_percent"};
  trend.medians = {{id, {10.0, 10.0, last}}};
  return trend;
}

TEST(StudyCourse, InPointsIsShownFromTheFirstDigitOn) {
  const auto course = worst_course(in_points(10.06), {}, {});
  ASSERT_TRUE(course);
  EXPECT_EQ(course->words, "bearing, ISOMAP, K = 6: MOE +0.1\u00a0points");
  EXPECT_FALSE(worst_course(in_points(10.04), {}, {})) << "+0.0 points is not a change";
  EXPECT_TRUE(best_course(in_points(9.5), {}));
  EXPECT_FALSE(best_course(in_points(9.6), {}));
}

TEST(StudyCourse, ComparesPointsWithPercentByWhatARuleFindsOfEach) {
  StudyTrend trend = in_points(14.0);
  const StudyTrend errors = two_settings();
  trend.medians.insert(errors.medians.begin(), errors.medians.end());
  NightlyFinding percent = two_findings()[0], points = percent;
  // Six times the least that is found.
  trend.medians[{"bearing", "isomap-K6", 150, "mpe_m"}] = {0.10, 0.10, 0.106};
  points.quantity = "moe_percent";
  points.change = 3.9;  // The median rose by 4.0, eight times.
  const auto course = worst_course(trend, {{3, {percent, points}}}, {});
  ASSERT_TRUE(course);
  EXPECT_TRUE(course->words.starts_with("bearing, ISOMAP: MOE +4.0\u00a0points")) << course->words;
}

TEST(RegressionMarks, ComeFirstInTheReportOfANightlyRun) {
  const NightlySummary summary = summary_of();
  Table table{.id = "t", .caption = "Bearing: MPE", .columns = {{"Method", "", "", ""}}};
  table.rows = {{{TextCell{"ISOMAP, K = 6"}}, ""}};
  table.secondary = true;
  Report report{.sections = {{"summary", "Summary", {}}, {"errors", "Errors", {table}}}};
  const NightlyRun nightly_run{.facts = summary.facts};
  NightlyLinks links({});
  add_nightly_run(report,
                  {.nightly_run = nightly_run,
                   .name = "mine",
                   .is_compared = true,
                   .lost = LostNightlyRuns{},
                   .groups = summary.groups,
                   .comparisons = {comparison_file(1, 2, "mine")}},
                  links);
  ASSERT_EQ(report.sections.size(), 3U);
  EXPECT_EQ(report.sections[0].id, "worse");
  EXPECT_EQ(report.sections[1].id, "errors");
  EXPECT_FALSE(std::get<Table>(report.sections[1].blocks[0]).secondary) << "it is not folded";
  const auto& found = std::get<FindingBlock>(report.sections[0].blocks[0]);
  EXPECT_EQ(found.title, "ISOMAP: MPE +20.0\u00a0% (K = 6 and 8)");
  EXPECT_NE(found.command.find("git bisect start"), std::string::npos);
  EXPECT_TRUE(found.keys.empty()) << "decisions are made on the index";
  EXPECT_TRUE(links.words().contains("compare/0001-0002/mine.html"));
  EXPECT_EQ(report.opening.standing->title, "Nightly run 3: accuracy got worse: 2 findings");
}

FindingSetting setting_of(const std::vector<ShownLevel>& levels) {
  FindingSetting setting{.levels = levels};
  for (const ShownLevel& level : levels)
    setting.shown += (setting.shown.empty() ? "" : ", ") + level.words();
  return setting;
}

TEST(RegressionMarks, AreOnTheRowsOfTablesWhoseColumnsAreLevels) {
  const FindingGroup group{
      .study = "mine",
      .setup = "indoors",
      .method = "MCL",
      .settings = {setting_of({{"noise", "0.1", "m"}}), setting_of({{"noise", "0.2", "m"}})},
      .quantity = "error",
      .changes = {18.0},
      .lines = {"MCL, noise 0.1 m", "MCL, noise 0.2 m"}};
  const auto of_levels = [](const std::string& caption, const std::string& level) {
    Table table{.id = "t", .caption = caption, .columns = {{"Method", "", "", ""}}};
    table.columns.push_back({level, "", "noise", ""});
    table.rows = {{{TextCell{"MCL"}, NumberCell{1.0}}, ""},
                  {{TextCell{"EKF"}, NumberCell{1.0}}, ""}};
    return table;
  };
  Report report{.sections = {{"s",
                              "S",
                              {of_levels("indoors: error [m], by noise", "0.1"),
                               of_levels("indoors: error [m], by noise", "0.15"),
                               of_levels("indoors, noise 0.2: error [m]", "Mean"),
                               of_levels("indoors, noise 0.25: error [m]", "Mean")}}}};
  mark_regressed(report, {}, std::vector{group}, "mine");
  const auto marks = [&](std::size_t block, std::size_t row) {
    return std::get<Table>(report.sections[0].blocks[block]).rows[row].regressed;
  };
  EXPECT_EQ(marks(0, 0), "error +18.0\u00a0% (noise 0.1 and 0.2\u00a0m)");
  EXPECT_EQ(marks(0, 1), "");
  EXPECT_EQ(marks(1, 0), "") << "another level";
  EXPECT_EQ(marks(2, 0), "error +18.0\u00a0%");
  EXPECT_EQ(marks(3, 0), "") << "another level";
}

TEST(RegressionMarks, AreOnTheRowsAndFiguresOfWhatGotWorse) {
  const NightlySummary summary = summary_of();
  Table table{.id = "t", .caption = "Bearing: MPE", .columns = {{"Method", "", "", ""}}};
  table.rows = {{{TextCell{"ISOMAP, K = 6"}}, ""}, {{TextCell{"LPCA"}}, ""}};
  Table other_sensor = table;
  other_sensor.id = "u";
  other_sensor.caption = "Range: MPE";
  Report report{
      .sections = {
          {"s", "S", {table, FigureBlock{.id = "f"}, FigureBlock{.id = "g"}, other_sensor}}}};
  Figure figure{.id = "f", .title = "Bearing: MPE over steps"};
  figure.panels.push_back({});
  figure.panels[0].layers.emplace_back(Polyline{.label = "ISOMAP, K = 8"});
  Figure other = figure;
  other.id = "g";
  other.title = "Bearing: MOE over steps";
  mark_regressed(report, std::vector{figure, other}, summary.groups, "mine");
  const auto& blocks = report.sections[0].blocks;
  EXPECT_EQ(std::get<Table>(blocks[0]).rows[0].regressed, "MPE +20.0\u00a0%");
  EXPECT_EQ(std::get<Table>(blocks[0]).rows[1].regressed, "");
  EXPECT_EQ(std::get<FigureBlock>(blocks[1]).regressed, "ISOMAP: MPE +20.0\u00a0% (K = 6 and 8)");
  EXPECT_EQ(std::get<FigureBlock>(blocks[1]).regressed_curves,
            (std::vector<RegressedCurve>{{.label = "ISOMAP, K = 8"}}));
  EXPECT_EQ(std::get<FigureBlock>(blocks[2]).regressed, "");
  EXPECT_EQ(std::get<Table>(blocks[3]).rows[0].regressed, "");
}

/// The curves that are marked in a figure for a finding.
std::vector<RegressedCurve> marked_curves(Figure figure, const FindingGroup& group) {
  figure.id = "f";
  Report report{.sections = {{"s", "S", {FigureBlock{.id = "f"}}}}};
  mark_regressed(report, std::vector{figure}, std::vector{group}, "mine");
  const auto& block = std::get<FigureBlock>(report.sections[0].blocks[0]);
  EXPECT_EQ(block.regressed.empty(), block.regressed_curves.empty());
  return block.regressed_curves;
}

Panel panel_of(const std::string& title, const std::string& x, const std::string& y,
               const std::string& curve) {
  return {
      .title = title, .x = {.label = x}, .y = {.label = y}, .layers = {Polyline{.label = curve}}};
}

TEST(RegressionMarks, AreInThePanelsOfTheSetupAndTheQuantityOfTheFinding) {
  const FindingGroup group = summary_of().groups[0];
  const std::string curve = "ISOMAP, K = 6";
  const auto panels = [&](const std::string& title, const std::string& record,
                          const std::vector<std::string>& titles, const std::string& y) {
    Figure figure{.title = title, .record_ids = {record}};
    for (const std::string& one : titles)
      figure.panels.push_back(panel_of(one, "observations", y, curve));
    std::vector<std::size_t> marked;
    for (const RegressedCurve& one : marked_curves(figure, group)) marked.push_back(one.panel);
    return marked;
  };
  using Marked = std::vector<std::size_t>;
  EXPECT_EQ(panels("Visibility: MPE", "visibility", {""}, "MPE [m]"), Marked{});
  EXPECT_EQ(panels("Bearings of two rooms: MPE", "", {""}, "MPE [m]"), Marked{}) << "another one";
  EXPECT_EQ(panels("Bearing: MPE", "", {"", "K fixed"}, "MPE [m]"), (Marked{0, 1}));
  EXPECT_EQ(panels("My study: MPE", "bearing", {""}, "MPE [m]"), Marked{0}) << "one setup alone";
  EXPECT_EQ(panels("MPE by sensor", "bearing/lpca", {"Visibility", "Bearing"}, "MPE [m]"),
            Marked{1});
  EXPECT_EQ(panels("Bearing: lowest errors", "", {""}, "MOE [%]"), Marked{});
  Figure both{.title = "Bearing: MPE and MOE"};
  both.panels = {panel_of("", "observations", "MPE [m]", curve),
                 panel_of("", "observations", "MOE [%]", curve)};
  EXPECT_EQ(marked_curves(both, group), (std::vector<RegressedCurve>{{.label = curve}}));
}

TEST(RegressionMarks, AreWhereTheXAxisIsTheParameterOfTheSettings) {
  FindingGroup group = summary_of().groups[0];
  const auto marked = [&](const std::string& title, const std::string& x) {
    Figure figure{.title = "Bearing: MPE"};
    figure.panels = {panel_of(title, x, "MPE [m]", group.method)};
    return marked_curves(figure, group);
  };
  const auto at = [&](const std::vector<double>& points) {
    return std::vector<RegressedCurve>{{.label = group.method, .at = points}};
  };
  EXPECT_EQ(marked("", "K"), at({6.0, 8.0}));
  EXPECT_TRUE(marked("", "observations (steps)").empty());
  const ShownLevel pace{.name = "pace", .value = "2", .number = 2.0};
  const auto noise = [](const std::string& value, double number) {
    return ShownLevel{.name = "noise", .value = value, .number = number};
  };
  group.settings = {setting_of({noise("0.1", 0.1), pace}), setting_of({noise("10⁻⁵", 1e-5), pace})};
  EXPECT_EQ(marked("pace 2", "noise [m]"), at({0.1, 1e-5}));
  EXPECT_EQ(marked("pace 2", "laser noise [m]"), at({0.1, 1e-5}));
  EXPECT_TRUE(marked("pace 3", "noise [m]").empty());
  EXPECT_TRUE(marked("pace 2", "noise floor").empty());
  group.settings = {setting_of({noise("0.1", 0.1)})};
  group.settings[0].parameter = {.name = "K", .value = "6", .number = 6.0};
  EXPECT_EQ(marked("noise 0.1", "K"), at({6.0}));
  group.settings = {FindingSetting{.shown = "fast"}};
  EXPECT_TRUE(marked("", "K").empty()) << "it is not on the axis";
  group.settings = {};
  EXPECT_EQ(marked("", "K"), at({})) << "all points are of the method";
}

/// So many findings, each of its own method.
std::vector<NightlyFinding> many_findings(int count) {
  std::vector<NightlyFinding> findings;
  for (int i = 1; i <= count; ++i)
    findings.push_back({.study = "mine",
                        .subject = "method " + std::to_string(i),
                        .quantity = "mpe_m",
                        .since = 3,
                        .change = 10.0});
  return findings;
}

std::string last_words(const Section& section) {
  const auto* last = std::get_if<Paragraph>(&section.blocks.back());
  std::string words;
  if (last != nullptr)
    for (const Phrase& phrase : last->phrases)
      words += phrase.text + (phrase.element.empty() ? "" : "#" + phrase.element);
  return words;
}

TEST(HistoryPages, ShowTheFirstFindingsOfManyAndEveryNote) {
  const StudyTrend trend = two_settings();
  const HistoryPage index =
      index_page({.nightly_runs = trend.nightly_runs,
                  .findings = {{3, many_findings(40)}},
                  .trends = {trend},
                  .notes = {{.nightly_run = 3, .finding = 2, .text = "with its finding"},
                            {.nightly_run = 3, .finding = 40, .text = "of the last"}}},
                 {});
  const Section& worse = index.report.sections.at(0);
  EXPECT_EQ(worse.blocks.size(), 31U);
  EXPECT_EQ(index.link_words.at("trends/mine/report.html#section-findings"),
            "all findings of mine");
  EXPECT_EQ(last_words(worse), "And 10 more, among trends/mine/report.html#section-findings.");
  std::vector<std::string> notes;
  for (const Block& block : index.report.sections.at(1).blocks)
    if (const auto* note = std::get_if<Callout>(&block))
      notes.push_back(note->title + ": " + note->text.phrases.front().text);
  EXPECT_EQ(notes, std::vector<std::string>{"Note on 3.40: of the last"});
}

TEST(NightlyReports, BeginWithTheFirstFindingsOfMany) {
  const StudyTrend trend = two_settings();
  const auto summary = last_summary({.nightly_runs = trend.nightly_runs,
                                     .findings = {{3, many_findings(500)}},
                                     .trends = {trend}});
  ASSERT_EQ(summary.groups.size(), 500U);
  Report report{.sections = {{"summary", "Summary", {}}}};
  const NightlyRun nightly_run{.facts = summary.facts};
  NightlyLinks links({});
  add_nightly_run(report,
                  {.nightly_run = nightly_run,
                   .name = "mine",
                   .is_compared = true,
                   .lost = LostNightlyRuns{},
                   .groups = summary.groups},
                  links);
  EXPECT_EQ(report.sections.at(0).blocks.size(), 31U);
  EXPECT_EQ(last_words(report.sections[0]),
            "And 470 more, among trends/mine/report.html#section-findings.");
}

}  // namespace
}  // namespace mapproof::test
