#include "reports/history/nightly_summary.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "reports/history/history_pages.hpp"
#include "reports/history/nightly_standing.hpp"

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
  trend.levels[{"bearing", "isomap-K6", 150, "mpe_m"}] = {0.0, std::log(1.2), std::log(1.2)};
  trend.levels[{"bearing", "lpca", 150, "mpe_m"}] = {0.0, 0.0, 0.0};
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
  EXPECT_EQ(group.headline(), "ISOMAP: MPE +17.6\u00a0% (K = 6 and 8)");
  EXPECT_EQ(group.commits.text(), "aaaaaaaaa..bbbbbbbbb");
  EXPECT_EQ(group.commits.url(), "https://github.com/me/x/compare/" + std::string(40, 'a') + "..." +
                                     std::string(40, 'b'));
  EXPECT_EQ(group.commits.bisect(),
            "git bisect start bbbbbbbbb aaaaaaaaa && git bisect run sh -c '(make -j4) || exit 125; "
            "mapproof nightly mine --store '\\''my history'\\'' --bisect 2'");
  EXPECT_EQ(summary.short_verdict(), "MPE +17.6\u00a0%");
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
  EXPECT_NE(all.title().find("2 known"), std::string::npos) << all.title();
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
  EXPECT_EQ(json["message"], "MPE +17.6 %");
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
                  .notes = {{.nightly_run = 3, .text = "a note"}},
                  .comparisons = {comparison_file(1, 2, "mine")}},
                 {});
  EXPECT_NO_THROW(check(index.report));
  EXPECT_EQ(index.report.opening.standing->sentences.front(),
            "mine: bearing, ISOMAP: MPE +17.6\u00a0% (K = 6 and 8), since nightly run 2, commits "
            "aaaaaaaaa..bbbbbbbbb.");
  ASSERT_EQ(index.report.sections.front().id, "worse");
  const auto& found = std::get<FindingBlock>(index.report.sections.front().blocks.front());
  EXPECT_EQ(found.keys, "3.1 3.2");
  EXPECT_EQ(found.details.size(), 2U) << "statistics are behind a click";
  EXPECT_TRUE(index.link_words.contains("compare/0001-0002/mine.html"));
  const Table* studies = tables(index.report).front();
  ASSERT_EQ(studies->id, "studies");
  ASSERT_EQ(studies->rows.size(), 1U);
  EXPECT_NEAR(studies->rows[0].curve.back(), 100.0 * (std::sqrt(1.2) - 1.0), 1e-9);
  EXPECT_EQ(std::get<TextCell>(studies->rows[0].cells[2]).text,
            "bearing, ISOMAP, K = 6: MPE +20.0\u00a0%");
}

TEST(RegressionMarks, AreOnTheRowsOfTablesWhoseColumnsAreLevels) {
  const FindingGroup group{.study = "mine",
                           .setup = "indoors",
                           .method = "MCL",
                           .settings = {"noise=0.1", "noise=0.2"},
                           .quantity = "error",
                           .changes = {18.0},
                           .lines = {"MCL, noise=0.1", "MCL, noise=0.2"}};
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
  EXPECT_EQ(marks(0, 0), "error +18.0\u00a0% (noise=0.1 and 0.2)");
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
  Report report{.sections = {{"s", "S", {table, FigureBlock{.id = "f"}, FigureBlock{.id = "g"},
                                     other_sensor}}}};
  Figure figure{.id = "f", .title = "MPE over steps"};
  figure.panels.push_back({});
  figure.panels[0].layers.emplace_back(Polyline{.label = "ISOMAP, K = 8"});
  Figure other = figure;
  other.id = "g";
  other.title = "MOE over steps";
  mark_regressed(report, std::vector{figure, other}, summary.groups, "mine");
  const auto& blocks = report.sections[0].blocks;
  EXPECT_EQ(std::get<Table>(blocks[0]).rows[0].regressed, "MPE +17.6\u00a0%");
  EXPECT_EQ(std::get<Table>(blocks[0]).rows[1].regressed, "");
  EXPECT_EQ(std::get<FigureBlock>(blocks[1]).regressed, "ISOMAP: MPE +17.6\u00a0% (K = 6 and 8)");
  EXPECT_EQ(std::get<FigureBlock>(blocks[2]).regressed, "");
  EXPECT_EQ(std::get<Table>(blocks[3]).rows[0].regressed, "");
}

}  // namespace
}  // namespace mapproof::test
