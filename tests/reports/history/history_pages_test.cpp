#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>
#include <variant>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/json/json_text.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/value_fields.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/method_series.hpp"
#include "reports/history/history_export.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/nightly_standing.hpp"
#include "reports/history/pages/history_pages.hpp"
#include "reports/history/pages/history_tables.hpp"
#include "reports/history/shown_names.hpp"
#include "tests/reports/history/sample_nightly_runs.hpp"
#include "tests/support/schemas/schema_problem.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

TEST(HistoryPages, AreValidReportsAndFigures) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  NightlyFindings findings;
  for (int number = 1; number <= 6; ++number) {
    Plant plant;
    if (number >= 5) plant.error = {{"lpca", 1.1}};
    findings[number] = judged(store, sample_nightly_run(number, 1, plant)).findings;
  }
  const HistoryPage page =
      trend_page(store.trend("sample", "d", 60, 6), findings, true, {"../../", "../../"});
  EXPECT_NO_THROW(check(page.report));
  ASSERT_EQ(page.figures.size(), 3U);  // MPE, seconds, memory.
  for (const Figure& figure : page.figures) EXPECT_EQ(problem(figure), "");
  const HistoryPage index = index_page({.nightly_runs = store.nightly_runs(),
                                        .findings = findings,
                                        .trends = {store.trend("sample", "d", 60, 6)}},
                                       {});
  EXPECT_NO_THROW(check(index.report));
  ASSERT_EQ(index.figures.size(), 2U);
  EXPECT_EQ(index.figures.front().id, "trend-mpe-m-bearing") << "what got worse goes first";
  EXPECT_NO_THROW(check(index_page({}, {}).report));
}

TEST(HistoryPages, BeginWithThreeFindingsAndSayHowManyMore) {
  NightlyRun nightly_run{.facts = {.number = 5, .started_utc = "2026-11-22T02:30:07Z"}};
  for (int i = 1; i <= 7; ++i)
    nightly_run.findings.push_back({.study = "mine",
                                    .subject = fmt::format("method {}", i),
                                    .quantity = "mpe_m",
                                    .since = 5,
                                    .change = i});
  const std::vector<FindingGroup> groups = grouped(5, nightly_run.findings, {}, {});
  NightlyLinks links({});
  const Standing stands = study_standing(nightly_run.facts, groups, "mine", true, links);
  EXPECT_EQ(stands.title, "Nightly run 5: accuracy got worse: 7 findings");
  ASSERT_EQ(stands.sentences.size(), 3U);
  EXPECT_EQ(stands.sentences[2], "method 5: mpe_m +5.0\u00a0%.");
  ASSERT_EQ(stands.rest.size(), 1U);
  EXPECT_EQ(stands.rest[0].phrases[0].text, "And 4 more findings, among ");
  EXPECT_EQ(stands.rest[0].phrases[1].text, "trends/mine/report.html");
  EXPECT_EQ(stands.rest[0].phrases[1].element, "section-findings");
  EXPECT_EQ(stands.note, "All of these got worse since nightly run 5.");

  const Report index = index_page({.nightly_runs = {nightly_run.facts},
                                   .findings = {{5, nightly_run.findings}},
                                   .studies = {{5, {"mine"}}}},
                                  {})
                           .report;
  EXPECT_EQ(index.subtitle, "1 nightly run, the last begun 2026-11-22 02:30 UTC");
  ASSERT_TRUE(index.opening.standing.has_value());
  EXPECT_TRUE(index.opening.standing->worse);
  EXPECT_EQ(index.opening.standing->sentences.size(), 3U);
  EXPECT_EQ(index.opening.standing->rest.size(), 1U);
}

TEST(HistoryPages, ShowTheLastFindingInsteadOfCountingIt) {
  std::vector<NightlyFinding> findings;
  for (int i = 1; i <= 4; ++i)
    findings.push_back({.study = "mine",
                        .subject = fmt::format("method {}", i),
                        .quantity = "mpe_m",
                        .since = 5,
                        .change = i});
  const std::vector<FindingGroup> groups = grouped(5, findings, {}, {});
  NightlyLinks links({});
  const Standing stands = study_standing({.number = 5}, groups, "mine", true, links);
  EXPECT_TRUE(stands.rest.empty());
  ASSERT_EQ(stands.sentences.size(), 4U);
  EXPECT_EQ(stands.sentences[3], "method 1: mpe_m +1.0\u00a0%.");
}

/// A trend of two settings of ISOMAP, the first of which was best until the last nightly run.
StudyTrend best_got_worse() {
  StudyTrend trend{.name = "mine"};
  for (int number = 1; number <= 4; ++number) trend.nightly_runs.push_back({.number = number});
  trend.peak_memory_mib = {80, 80, 80, 80};
  trend.medians[{"bearing", "isomap-K5", 150, "mpe_m"}] = {0.10, 0.10, 0.10, 0.20};
  trend.medians[{"bearing", "isomap-K6", 150, "mpe_m"}] = {0.15, 0.15, 0.15, 0.15};
  trend.medians[{"bearing", "isomap-K7", 150, "mpe_m"}] = {0.12, 0.12, 0.12, 0.12};
  return trend;
}

std::vector<std::string> curves(const Figure& figure) {
  std::vector<std::string> labels;
  for (const Layer& layer : figure.panels.front().layers)
    if (const auto* line = std::get_if<Polyline>(&layer)) labels.push_back(line->label);
  return labels;
}

TEST(HistoryPages, ShowTheSettingThatWasBestAndGotWorseAndMarkTheNightlyRun) {
  const StudyTrend trend = best_got_worse();
  EXPECT_EQ(curves(trend_figures(trend, {}).front()), std::vector<std::string>{"ISOMAP, K = 5"});
  const NightlyFindings findings = {
      {4,
       {{.study = "mine", .subject = "bearing, isomap-K5, 150 steps", .quantity = "mpe_m"},
        {.study = "mine", .subject = "bearing, isomap-K6, 150 steps", .quantity = "mpe_m"},
        {.study = "another", .subject = "bearing, isomap-K7, 150 steps", .quantity = "mpe_m"}}}};
  const Figure figure = trend_figures(trend, findings).front();
  EXPECT_EQ(curves(figure), std::vector<std::string>(2, "ISOMAP, 2 of 3 settings"));
  std::vector<std::pair<double, double>> marked;
  for (const Layer& layer : figure.panels.front().layers)
    if (const auto* mark = std::get_if<Scatter>(&layer))
      marked.emplace_back(mark->x.front(), mark->y.front());
  EXPECT_EQ(marked, (std::vector<std::pair<double, double>>{{3, 100.0}, {3, 0.0}}));
}

TEST(HistoryPages, LabelWhatAStudyDeclaresAsItDoes) {
  StudyTrend trend = best_got_worse();
  trend.quantities.declare(
      study_quantity("found_percent", "Landmarks found", "%", Better::kHigher));
  trend.medians[{"size", "isomap-K5 level=30", 0, "found_percent"}] = {90, 91, 92, 93};
  trend.medians[{"size", "isomap-K5 level=50", 0, "found_percent"}] = {80, 81, 82, 83};
  const std::vector<Figure> figures = trend_figures(trend, {});
  ASSERT_EQ(figures.size(), 2U);  // MPE and what is declared; memory did not change.
  EXPECT_EQ(figures[1].id, "trend-found-percent-size");
  EXPECT_EQ(figures[1].panels.front().y.label, "change of Landmarks found [points]");
  EXPECT_EQ(curves(figures[1]), std::vector<std::string>{"ISOMAP, K = 5, level 30"})
      << "the better level stands for the method";
  const Table table = accuracy_table(trend);
  EXPECT_EQ(std::get<TextCell>(table.rows.back().cells[1]).text, "Landmarks found");
}

using DrawnStyle = std::tuple<ThemeColour, Dash, Marker>;

DrawnStyle style_in_figures(Method method) {
  const SeriesStyle style = series_style(method_series(method));
  return {style.colour, style.dash, style.marker};
}

/// The styles of the lines under each name of a figure's legend.
std::map<std::string, std::set<DrawnStyle>> drawn_styles(const Figure& figure) {
  std::map<std::string, std::set<DrawnStyle>> styles;
  for (const Layer& layer : figure.panels.front().layers)
    if (const auto* line = std::get_if<Polyline>(&layer))
      styles[line->label].insert({line->colour, line->dash, line->marker});
  return styles;
}

/// The names at the ends of a figure's lines.
std::vector<std::string> end_labels(const Figure& figure) {
  for (const Layer& layer : figure.panels.front().layers)
    if (const auto* labels = std::get_if<PointLabels>(&layer)) return labels->text;
  return {};
}

TEST(HistoryPages, GiveAMethodOneStyleInAllFiguresAndNameItsSettingsAtTheirEnds) {
  StudyTrend trend = best_got_worse();
  trend.medians[{"bearing", "lpca", 150, "mpe_m"}] = {0.20, 0.20, 0.20, 0.21};
  trend.medians[{"visibility", "isomap-K5", 150, "mpe_m"}] = {0.30, 0.30, 0.30, 0.40};
  trend.medians[{"visibility", "isomap-K7", 150, "mpe_m"}] = {0.22, 0.22, 0.22, 0.21};
  const NightlyFindings findings = {
      {4,
       {{.study = "mine", .subject = "bearing, isomap-K7, 150 steps", .quantity = "mpe_m"},
        {.study = "mine", .subject = "visibility, isomap-K5, 150 steps", .quantity = "mpe_m"}}}};
  const std::vector<Figure> figures = trend_figures(trend, findings);
  ASSERT_EQ(figures.size(), 2U);
  const std::set<DrawnStyle> isomap = {style_in_figures(Method::kIsomap)},
                             lpca = {style_in_figures(Method::kLpca)};
  const auto& bearing =
      *std::ranges::find(figures, std::string("trend-mpe-m-bearing"), &Figure::id);
  EXPECT_EQ(drawn_styles(bearing), (std::map<std::string, std::set<DrawnStyle>>{
                                       {"ISOMAP, 2 of 3 settings", isomap}, {"LPCA", lpca}}));
  EXPECT_EQ(end_labels(bearing), (std::vector<std::string>{"K = 5", "K = 7"}));
  EXPECT_TRUE(bearing.caption.find("The ends of lines name the settings") != std::string::npos);
  const auto& visibility =
      *std::ranges::find(figures, std::string("trend-mpe-m-visibility"), &Figure::id);
  EXPECT_EQ(drawn_styles(visibility),
            (std::map<std::string, std::set<DrawnStyle>>{{"ISOMAP, both settings", isomap}}));
  // Where one setting is shown, whichever it is.
  trend.medians.erase({"visibility", "isomap-K5", 150, "mpe_m"});
  for (const Figure& figure : trend_figures(trend, {})) {
    if (figure.id != "trend-mpe-m-visibility") continue;
    EXPECT_EQ(drawn_styles(figure),
              (std::map<std::string, std::set<DrawnStyle>>{{"ISOMAP, K = 7", isomap}}));
    EXPECT_TRUE(end_labels(figure).empty());
  }
}

TEST(HistoryPages, GiveTheLevelsOfAMethodOfAnotherProgramTheStyleOfTheMethod) {
  StudyTrend trend{.name = "mine"};
  for (int number = 1; number <= 2; ++number) trend.nightly_runs.push_back({.number = number});
  trend.labels = {.methods = {{"ekf", "EKF"}, {"mcl", "MCL"}, {"graph", "Graph SLAM"}},
                  .factors = {{"noise", {"range noise", "m"}}}};
  NightlyFindings findings;
  for (const double level : {0.1, 0.2, 0.5}) {
    const std::string method = fmt::format("graph noise={}", level);
    trend.medians[{"hall", method, 0, "mpe_m"}] = {0.1, 0.1 + level};
    findings[2].push_back({.study = "mine", .subject = "hall, " + method, .quantity = "mpe_m"});
  }
  trend.medians[{"hall", "ekf noise=0.1", 0, "mpe_m"}] = {0.1, 0.1};
  trend.medians[{"hall", "mcl noise=0.1", 0, "mpe_m"}] = {0.1, 0.1};
  const Figure figure = trend_figures(trend, findings).front();
  EXPECT_EQ(problem(figure), "");
  std::set<Marker> markers;
  for (const auto& [label, styles] : drawn_styles(figure)) {
    ASSERT_EQ(styles.size(), 1U) << label;
    EXPECT_TRUE(markers.insert(std::get<Marker>(*styles.begin())).second)
        << label << " has the marker of another method";
  }
  EXPECT_EQ(markers.size(), 3U);
  EXPECT_TRUE(drawn_styles(figure).contains("Graph SLAM, all 3 settings"));
  EXPECT_EQ(end_labels(figure),
            (std::vector<std::string>{"range noise 0.1\u00a0m", "range noise 0.2\u00a0m",
                                      "range noise 0.5\u00a0m"}));
}

TEST(HistoryPages, NameTheSettingsOfLinesThatEndTogetherInTheirTipsAlone) {
  StudyTrend trend{.name = "mine"};
  for (int number = 1; number <= 2; ++number) trend.nightly_runs.push_back({.number = number});
  NightlyFindings findings;
  constexpr int kSettings = 16;
  for (int k = 5; k < 5 + kSettings; ++k) {
    const std::string method = fmt::format("isomap-K{}", k);
    trend.medians[{"bearing", method, 150, "mpe_m"}] = {0.1 * k, 0.2 * k};
    findings[2].push_back(
        {.study = "mine", .subject = "bearing, " + method + ", 150 steps", .quantity = "mpe_m"});
  }
  const Figure figure = trend_figures(trend, findings).front();
  std::set<std::string> settings, of_findings;
  const auto add_setting = [](const Mark& mark, std::set<std::string>& all) {
    for (const auto& [key, value] : mark.data)
      if (key == "setting") all.insert(value);
  };
  for (const Layer& layer : figure.panels.front().layers)
    if (const auto* line = std::get_if<Polyline>(&layer))
      add_setting(line->mark, settings);
    else if (const auto* found = std::get_if<Scatter>(&layer))
      for (const Mark& mark : found->marks) add_setting(mark, of_findings);
  EXPECT_EQ(settings, of_findings) << "the ring of a finding names the setting of its line";
  EXPECT_EQ(settings.size(), kSettings) << "all are drawn";
  EXPECT_TRUE(settings.contains("ISOMAP, K = 20"));
  EXPECT_EQ(drawn_styles(figure),
            (std::map<std::string, std::set<DrawnStyle>>{
                {"ISOMAP, all 16 settings", {style_in_figures(Method::kIsomap)}}}));
  EXPECT_TRUE(end_labels(figure).empty());

  findings[2].erase(findings[2].begin());  // The best one got no worse.
  EXPECT_EQ(drawn_styles(trend_figures(trend, findings).front()), drawn_styles(figure))
      << "it is drawn, too";
}

TEST(HistoryPages, ShowWhatTheFirstNightlyRunMeasuredInsteadOfATrend) {
  StudyTrend trend{.name = "mine", .nightly_runs = {{.number = 3}}, .peak_memory_mib = {80}};
  trend.medians[{"bearing", "lpca", 150, "mpe_m"}] = {0.3};
  trend.medians[{"bearing", "isomap-K6", 150, "mpe_m"}] = {0.0612};
  const std::vector<Figure> figures = trend_figures(trend, {});
  ASSERT_EQ(figures.size(), 1U);
  EXPECT_EQ(figures[0].title, "Bearing: ISOMAP, K = 6 has the lowest MPE, 0.0612\u00a0m");
  EXPECT_EQ(figures[0].panels.front().y.names, (std::vector<std::string>{"LPCA", "ISOMAP, K = 6"}));
  EXPECT_EQ(problem(figures[0]), "");
  EXPECT_EQ(trend_sentences(trend, {}),
            (std::vector<std::string>{"Bearing: MPE from 0.0612\u00a0m (ISOMAP, K = 6) to "
                                      "0.300\u00a0m (LPCA), 2 methods in nightly run 3.",
                                      "Peak memory 80.0\u00a0MiB in nightly run 3."}));
  const HistoryPage index = index_page({.nightly_runs = {{.number = 3}}, .trends = {trend}}, {});
  EXPECT_EQ(index.report.opening.main_figure, figures[0].id);
  EXPECT_EQ(index.report.opening.findings.at(1).phrases.front().text, "Measured");
  const HistoryPage page = trend_page(trend, {}, false, {});
  EXPECT_NO_THROW(check(page.report));
  EXPECT_EQ(page.report.opening.main_figure, figures[0].id);
}

TEST(HistoryPages, DrawNoTrendOfWhatDidNotChangeUnlessItHasAFinding) {
  StudyTrend trend{.name = "mine", .nightly_runs = {{.number = 1}, {.number = 2}}};
  trend.peak_memory_mib = {80, 81};
  const SeriesId series{"bearing", "lpca", 150, "mpe_m"};
  trend.medians[series] = {0.3, 0.3 * (1.0 + 1e-12)};
  ASSERT_EQ(trend_figures(trend, {}).size(), 1U);
  EXPECT_EQ(trend_figures(trend, {}).front().id, "trend-memory");
  EXPECT_EQ(trend_figures(trend, {}).front().title,
            "Peak memory changed by +1.2\u00a0% since nightly run 1");
  EXPECT_EQ(trend_sentences(trend, {}),
            (std::vector<std::string>{
                "Bearing: MPE 0.300\u00a0m (LPCA); change 0\u00a0% in 2 nightly runs."}));
  const NightlyFindings findings = {
      {2, {{.study = "mine", .subject = "bearing, lpca, 150 steps", .quantity = "mpe_m"}}}};
  EXPECT_EQ(trend_figures(trend, findings).front().id, "trend-mpe-m-bearing");
  EXPECT_TRUE(trend_sentences(trend, findings).empty());
  trend.medians[series] = {0.3, 0.301};
  const Figure moved = trend_figures(trend, {}).front();
  EXPECT_EQ(moved.title, "Bearing: MPE has not got worse");
  trend.medians[{"bearing", "lpca", 150, "seconds"}] = {1.0, 1.5};
  trend.medians[{"bearing", "isomap-K6", 150, "seconds"}] = {2.0, 1.8};
  EXPECT_EQ(trend_figures(trend, {})[1].title,
            "Bearing: seconds changed by −10 to +50\u00a0%, without a finding");
  trend.medians[series] = {0.3, NAN};
  EXPECT_EQ(trend_figures(trend, {}).front().id, "trend-seconds-bearing")
      << "one value is not a course";
}

TEST(HistoryPages, GiveTheHourWhereAllNightlyRunsAreOfOneDay) {
  StudyTrend trend = best_got_worse();
  const auto ticks = [&] { return trend_figures(trend, {}).front().panels.front().x; };
  for (NightlyFacts& nightly_run : trend.nightly_runs)
    nightly_run.started_utc = fmt::format("2026-11-22T0{}:30:07Z", nightly_run.number);
  EXPECT_EQ(ticks().label, "nightly run: time on 2026-11-22");
  EXPECT_EQ(ticks().names.front(), "1: 01:30");
  const std::string first = trend.nightly_runs.front().started_utc;
  trend.nightly_runs.back().started_utc = first;
  EXPECT_EQ(ticks().label, "nightly run, 2026-11-22");
  EXPECT_EQ(ticks().names.front(), "1");
  trend.nightly_runs.back().started_utc = "2026-11-23T04:30:07Z";
  EXPECT_EQ(ticks().label, "nightly run: date");
  EXPECT_EQ(ticks().names.front(), "1: 11-22");
}

TEST(HistoryPages, LinkTheCommitsSinceTheReferenceRun) {
  const NightlyFacts before{.number = 3, .commit = "abc1"};
  const NightlyFacts last{
      .number = 4, .commit = "abd2", .repository = "https://host/a/b", .reference = 3};
  const HistoryPage index =
      index_page({.nightly_runs = {before, last}, .trends = {best_got_worse()}}, {});
  EXPECT_EQ(index.link_words.at("https://host/a/b/compare/abc1...abd2"), "abc1..abd2");
  const std::vector<Phrase>& compared = index.report.opening.compared_with.phrases;
  EXPECT_TRUE(std::ranges::any_of(
      compared, [](const Phrase& phrase) { return phrase.emphasis == Emphasis::kUrl; }));
}

TEST(HistoryPages, LinkEachNightlyRunOfTheirTableByOneWord) {
  NightlyLinks links({});
  const Table table = nightly_runs_table(
      {.nightly_runs = {{.number = 1}, {.number = 2}}, .studies = {{2, {"mine"}}}}, links);
  const auto link = [&](std::size_t row) { return std::get<TextCell>(table.rows[row].cells[7]); };
  EXPECT_EQ(link(0).shown, "report");
  EXPECT_EQ(links.words().at(link(0).text), "report of nightly run 2");
  EXPECT_EQ(link(1).shown, "folder");
  EXPECT_EQ(links.words().at(link(1).text), "folder of nightly run 1");
}

TEST(HistoryRules, JudgeOneOfTheTwoOrientationErrors) {
  const SeriesId plain{"bearing", "lpca", 9, "moe_percent"};
  const SeriesId reflected{"bearing", "lpca", 9, "moe_unmirrored_percent"};
  Scores both = {{plain, {}}, {reflected, {}}}, alone = {{reflected, {}}};
  EXPECT_EQ(rule_of(plain, {}, both), NightlyRule::kPoints);
  EXPECT_EQ(rule_of(reflected, {}, both), NightlyRule::kKept);
  EXPECT_EQ(rule_of(reflected, {}, alone), NightlyRule::kPoints);
}

TEST(HistoryPages, SayOfANightlyRunThatWasNotComparedThatItWasNot) {
  const StudyTrend trend = best_got_worse();
  const auto& stands = trend_page(trend, {}, false, {}).report.opening.standing;
  ASSERT_TRUE(stands.has_value());
  EXPECT_TRUE(stands->title.starts_with("Nightly run 4: not compared")) << stands->title;
  const NightlyFacts nightly_run{.number = 4};
  EXPECT_EQ(verdict_word(nightly_run), "not compared");
  EXPECT_EQ(verdict_word({.number = 4, .reference = 2}), "passed");
  NightlyLinks links({});
  EXPECT_TRUE(nightly_standing({.facts = nightly_run}, links)
                  .title.starts_with("Nightly run 4: not compared"));
}

/// The links of a paragraph, by what they say.
std::map<std::string, std::string> links_of(const Paragraph& paragraph,
                                            const std::map<std::string, std::string>& words) {
  std::map<std::string, std::string> links;
  for (const Phrase& phrase : paragraph.phrases)
    if (phrase.emphasis == Emphasis::kFile) links[words.at(phrase.text)] = phrase.text;
  return links;
}

TEST(HistoryPages, LeadToEachOtherInWords) {
  NightlyRun nightly_run{.facts = {.number = 5, .reference = 3}};
  Report report;
  NightlyLinks links({.pages = "../../../", .nightly_runs = "../../../"});
  add_nightly_run(
      report,
      {.nightly_run = nightly_run, .name = "mine", .is_compared = true, .lost = LostNightlyRuns{}},
      links);
  EXPECT_EQ(links_of(report.opening.findings.front(), links.words()),
            (std::map<std::string, std::string>{
                {"all nightly runs", "../../../index.html"},
                {"trends of mine", "../../../trends/mine/report.html"},
                {"report of nightly run 3", "../../../nightly_runs/0003/mine/report.html"}}));
  const HistoryPage trends = trend_page(best_got_worse(), {}, false, {"../../", "../../"});
  EXPECT_EQ(links_of(trends.report.opening.findings.front(), trends.link_words),
            (std::map<std::string, std::string>{
                {"all nightly runs", "../../index.html"},
                {"report of nightly run 4", "../../nightly_runs/0004/mine/report.html"}}));
}

TEST(HistoryPages, BeginWithWhatRanLastAndWhatItWasComparedWith) {
  const NightlyFacts before{
      .number = 3, .started_utc = "2026-11-20T01:00:00Z", .commit = "abc1", .reference = 2};
  const NightlyFacts last{.number = 4, .reference = 3};
  const HistoryPage index =
      index_page({.nightly_runs = {before, last}, .trends = {best_got_worse()}}, {});
  const std::vector<Paragraph>& findings = index.report.opening.findings;
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_NE(findings[0].phrases.back().text.find("nightly run 4"), std::string::npos);
  EXPECT_NE(findings[0].phrases.back().text.find("of mine."), std::string::npos);
  const std::string& compared = index.report.opening.compared_with.phrases.at(0).text;
  EXPECT_NE(compared.find("nightly run 3"), std::string::npos) << compared;
  EXPECT_NE(compared.find("abc1, the last one that passed."), std::string::npos) << compared;
  EXPECT_TRUE(links_of(findings[1], index.link_words).contains("report of nightly run 4"));
}

TEST(HistoryPages, SayThatAHistoryWasDamagedAndWhereItsReportsAre) {
  const NightlyRun nightly_run{.facts = {.number = 5}};
  const LostNightlyRuns lost{.kept_as = {"history.sqlite.damaged-1"}, .reports = {{4, {"mine"}}}};
  Report report;
  NightlyLinks links({});
  add_nightly_run(report,
                  {.nightly_run = nightly_run, .name = "mine", .is_compared = false, .lost = lost},
                  links);
  EXPECT_TRUE(report.opening.standing->worse);
  EXPECT_NE(report.opening.standing->sentences.back().find("history.sqlite.damaged-1"),
            std::string::npos);
  EXPECT_TRUE(
      links_of(report.opening.findings.at(1), links.words()).contains("report of nightly run 4"));
  const HistoryPage index = index_page({.nightly_runs = {nightly_run.facts}, .lost = lost}, {});
  EXPECT_NO_THROW(check(index.report));
  EXPECT_EQ(index.report.sections.back().id, "lost");
  const auto* damage = std::get_if<Callout>(&index.report.sections.front().blocks.front());
  ASSERT_NE(damage, nullptr);
  EXPECT_NE(damage->text.phrases.front().text.find("history.sqlite.damaged-1"), std::string::npos);
}

TEST(HistoryPages, NameMethodsAsTheStudysReportDoes) {
  const StudyLabels own;
  EXPECT_EQ(shown_method(own, "isomap-K6"), "ISOMAP, K = 6");
  EXPECT_EQ(shown_method(own, "smacof-knn-K6"), "SMACOF, kNN weights, K = 6");
  EXPECT_EQ(shown_method(own, "kpca-gaussian-sigma2-10"), "KPCA, Gaussian, σ² = 10");
  EXPECT_EQ(shown_method(own, "isomap-K6 anchor-count=5"), "ISOMAP, K = 6, anchor-count 5");
  EXPECT_EQ(shown_method(own, "dead-reckoning"), "dead reckoning");
  EXPECT_EQ(shown_method(own, "factorization-of-9"), "factorization-of-9");
  EXPECT_EQ(shown_subject(own, {"bearing", "lpca", 150}), "bearing, LPCA, 150 steps");
}

TEST(HistoryPages, NameMethodsAsTheirStudyLabelsThem) {
  const StudyLabels labels{.setups = {{"hall", "Indoors, at nightly run"}},
                           .methods = {{"ekf", "My EKF"},
                                       {"ekf slow", "My EKF, slower"},
                                       {"spectral", "spectral"},
                                       {"isomap-K6", "Walk"}},
                           .factors = {{"noise", {"range noise", "m"}}}};
  EXPECT_EQ(shown_method(labels, "ekf"), "My EKF");
  EXPECT_EQ(shown_method(labels, "ekf noise=0.1 pace=2"), "My EKF, range noise 0.1\u00a0m, pace 2");
  EXPECT_EQ(shown_method(labels, "ekf noise=0.1 of robot 2"),
            "My EKF, range noise 0.1\u00a0m of robot 2");
  EXPECT_EQ(shown_method(labels, "ekf of robot 2"), "My EKF of robot 2");
  // Values and subjects may hold "=" and blanks.
  EXPECT_EQ(shown_method(labels, "ekf mode=lr=0.1"), "My EKF, mode lr=0.1");
  EXPECT_EQ(shown_method(labels, "ekf mode=lr=0.1 noise=1e-05"),
            "My EKF, mode lr=0.1, range noise 10\u207B\u2075\u00a0m");
  EXPECT_EQ(shown_method(labels, "ekf mode=very fast noise=0.1"),
            "My EKF, mode very fast, range noise 0.1\u00a0m");
  EXPECT_EQ(shown_method(labels, "ekf noise=0.1 of robot=2"),
            "My EKF, range noise 0.1\u00a0m of robot=2");
  EXPECT_EQ(shown_method(labels, "ekf =="), "My EKF,  =");
  EXPECT_EQ(shown_method(labels, "ekf fast"), "My EKF, fast");
  EXPECT_EQ(shown_method(labels, "ekf slow noise=0.1"), "My EKF, slower, range noise 0.1\u00a0m");
  EXPECT_EQ(shown_method(labels, "spectral"), "spectral");
  EXPECT_EQ(shown_method(labels, "isomap-K6"), "Walk");
  EXPECT_EQ(shown_method(labels, "isomap-K7 noise=0.1"), "isomap-K7, range noise 0.1\u00a0m");
  EXPECT_EQ(shown_subject(labels, {"hall", "ekf", 20}),
            "Indoors, at nightly run, My EKF, 20 steps");
  EXPECT_EQ(shown_subject(labels, {"", "ekf", 0}), "My EKF") << "there is one setup, without name";
}

TEST(HistoryPages, TakeNoTwoMethodsOfAnotherProgramForSettingsOfOne) {
  StudyTrend trend = best_got_worse();
  trend.labels.setups = {{"bearing", "By compass"}};
  for (const char* id : {"isomap-K5", "isomap-K6", "isomap-K7"})
    trend.labels.methods[id] = fmt::format("Walk {}", id);
  const Figure figure = trend_figures(trend, {}).front();
  EXPECT_EQ(curves(figure),
            (std::vector<std::string>{"Walk isomap-K5", "Walk isomap-K6", "Walk isomap-K7"}));
  EXPECT_EQ(figure.title, "By compass: MPE has not got worse");
  EXPECT_EQ(std::get<TextCell>(accuracy_table(trend).rows[0].cells[0]).text,
            "By compass, Walk isomap-K5, 150 steps");
}

/// What an export wrote.
std::string exported(HistoryStore& store, void (*as)(HistoryStore&, const TextSink&)) {
  std::string text;
  as(store, [&](std::string_view piece) { text += piece; });
  return text;
}

TEST(HistoryExport, HasALineAValue) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  store.append(sample_nightly_run(1, 1));
  const std::string csv = exported(store, export_history_csv);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 2 * 25);
  EXPECT_NE(csv.find(",bearing,\"ISOMAP, K = 6\"\r\n"), std::string::npos);
  const std::string text = exported(store, export_history_json);
  const auto json = nlohmann::ordered_json::parse(text);
  EXPECT_EQ(json["nightly_runs"][0]["studies"][0]["scores"].size(), 12U);
  EXPECT_EQ(text, json_text(json));
}

TEST(HistoryExport, OfNoNightlyRunIsWhole) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  const std::string text = exported(store, export_history_json);
  EXPECT_EQ(text, json_text(nlohmann::ordered_json::parse(text)));
  EXPECT_EQ(schema_problem("history", nlohmann::json::parse(text)), "");
}

TEST(HistoryExport, IsAsItsSchemasSay) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  std::vector<NightlyRun> nightly_runs;
  for (int number = 1; number <= 2; ++number) {
    NightlyRun nightly_run =
        sample_nightly_run(number, 1, {.error = {{"lpca", number == 2 ? 1.1 : 1.0}}});
    nightly_run.facts.provenance = json_line(to_json_value(Provenance{.version = "1.2"}));
    NightlyStudy& study = nightly_run.studies[0];
    study.quantities.declare(study_quantity("found", "Found", "%", Better::kHigher));
    study.labels = {.setups = {{"bearing", "By compass"}}, .methods = {{"lpca", "Mine"}}};
    study.figures = {{"fig-1.svg", "00", 1}};
    study.scores.begin()->second.front().value = NAN;
    nightly_runs.push_back(judged(store, nightly_run));
  }
  ASSERT_FALSE(nightly_runs[1].findings.empty());
  for (const NightlyRun& nightly_run : nightly_runs) {
    const auto file = nlohmann::json::parse(nightly_json(nightly_run));
    EXPECT_EQ(schema_problem("nightly_run", file), "");
    EXPECT_EQ(file["schema"],
              nlohmann::json::parse(R"({"name": "mapproof.nightly_run", "version": 1})"));
    EXPECT_EQ(file["provenance"]["version"], "1.2");
  }
  EXPECT_EQ(nlohmann::json::parse(nightly_json(nightly_runs[0]))["verdict"], "not compared");
  for (const bool with_scores : {false, true}) {
    const auto json = nlohmann::json::parse(with_scores ? exported(store, export_history_json)
                                                        : history_json(store).dump());
    EXPECT_EQ(schema_problem("history", json), "");
    EXPECT_EQ(json["nightly_runs"][1]["studies"][0].contains("scores"), with_scores);
    EXPECT_EQ(json["nightly_runs"][1]["studies"][0]["methods"].dump(),
              R"([{"id":"lpca","label":"Mine"}])");
  }
}

TEST(HistoryExport, KeepsWhatMadeANightlyRunAsThatNightlyRunWroteIt) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  NightlyRun nightly_run = sample_nightly_run(1, 1);
  nightly_run.facts.provenance = R"({"compiler": "of another version"})";
  store.append(nightly_run);
  EXPECT_EQ(history_json(store)["nightly_runs"][0]["provenance"]["compiler"], "of another version");
  EXPECT_FALSE(nightly_value(nightly_run.facts, {}).contains("schema"));
}

}  // namespace
}  // namespace mapproof::test
