#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reports/history/history_export.hpp"
#include "reports/history/history_pages.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/night_standing.hpp"
#include "reports/history/shown_names.hpp"
#include "tests/reports/history/sample_nights.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

TEST(HistoryPages, AreValidReportsAndFigures) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  NightFindings findings;
  for (int number = 1; number <= 6; ++number) {
    Plant plant;
    if (number >= 5) plant.error = {{"lpca", 1.1}};
    findings[number] = judged(store, sample_night(number, 1, plant)).findings;
  }
  const HistoryPage page = trend_page(store.trend("sample", "d", 60, 6), findings, true);
  EXPECT_NO_THROW(check(page.report));
  ASSERT_EQ(page.figures.size(), 3U);  // MPE, seconds, memory.
  for (const Figure& figure : page.figures) EXPECT_EQ(problem(figure), "");
  EXPECT_NO_THROW(check(index_page(store.nights(), findings, {}, {})));
  EXPECT_NO_THROW(check(index_page({}, {}, {}, {})));
}

TEST(HistoryPages, BeginWithThreeFindingsAndSayHowManyMore) {
  Night night{.facts = {.number = 5, .started_utc = "2026-11-22T02:30:07Z"}};
  for (int i = 1; i <= 7; ++i)
    night.findings.push_back({.study = "mine", .sentence = fmt::format("worse {}", i)});
  const Standing stands = study_standing(night.facts, night.findings, "mine", true);
  EXPECT_EQ(stands.title, "Night 5: 7 things got worse");
  ASSERT_EQ(stands.sentences.size(), 4U);
  EXPECT_EQ(stands.sentences[2], "worse 3.");
  EXPECT_TRUE(stands.sentences[3].starts_with("And 4 more"));

  const Report index =
      index_page(std::vector{night.facts}, {{5, night.findings}}, {{5, {"small"}}}, {});
  EXPECT_EQ(index.subtitle, "1 night, the last begun 2026-11-22 02:30 UTC");
  std::size_t items = 0;
  for (const Block& block : index.sections.front().blocks)
    if (const auto* list = std::get_if<BulletList>(&block)) items += list->items.size();
  EXPECT_EQ(items, 4U);
}

/// A trend of two settings of ISOMAP, the first of which was best until the last night.
StudyTrend best_got_worse() {
  StudyTrend trend{.name = "mine"};
  for (int number = 1; number <= 4; ++number) trend.nights.push_back({.number = number});
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

TEST(HistoryPages, ShowTheSettingThatWasBestAndGotWorseAndMarkTheNight) {
  const StudyTrend trend = best_got_worse();
  EXPECT_EQ(curves(trend_figures(trend, {}).front()), std::vector<std::string>{"ISOMAP, K = 5"});
  const NightFindings findings = {
      {4,
       {{.study = "mine", .subject = "bearing, isomap-K5, 150 steps", .quantity = "mpe_m"},
        {.study = "mine", .subject = "bearing, isomap-K6, 150 steps", .quantity = "mpe_m"},
        {.study = "another", .subject = "bearing, isomap-K7, 150 steps", .quantity = "mpe_m"}}}};
  const Figure figure = trend_figures(trend, findings).front();
  EXPECT_EQ(curves(figure), (std::vector<std::string>{"ISOMAP, K = 5", "ISOMAP, K = 6"}));
  std::vector<std::pair<double, double>> marked;
  for (const Layer& layer : figure.panels.front().layers)
    if (const auto* mark = std::get_if<Scatter>(&layer))
      marked.emplace_back(mark->x.front(), mark->y.front());
  EXPECT_EQ(marked, (std::vector<std::pair<double, double>>{{4, 0.20}, {4, 0.15}}));
}

TEST(HistoryPages, SayOfANightThatWasNotComparedThatItWasNot) {
  const StudyTrend trend = best_got_worse();
  const auto& stands = trend_page(trend, {}, false).report.opening.standing;
  ASSERT_TRUE(stands.has_value());
  EXPECT_TRUE(stands->title.starts_with("Night 4: not compared")) << stands->title;
  const NightFacts night{.number = 4};
  EXPECT_EQ(verdict_word(night), "not compared");
  EXPECT_EQ(verdict_word({.number = 4, .reference = 2}), "good");
  EXPECT_TRUE(night_standing(night, {}).title.starts_with("Night 4: not compared"));
}

TEST(HistoryPages, NameMethodsAsTheStudysReportDoes) {
  EXPECT_EQ(shown_method("isomap-K6"), "ISOMAP, K = 6");
  EXPECT_EQ(shown_method("smacof-knn-K6"), "SMACOF, kNN weights, K = 6");
  EXPECT_EQ(shown_method("kpca-gaussian-sigma2-10"), "KPCA, Gaussian, σ² = 10");
  EXPECT_EQ(shown_method("isomap-K6 anchor-count=5"), "ISOMAP, K = 6, anchor-count=5");
  EXPECT_EQ(shown_method("dead-reckoning"), "dead reckoning");
  EXPECT_EQ(shown_method("factorization-of-9"), "factorization-of-9");
  EXPECT_EQ(shown_subject("bearing, lpca, 150 steps"), "bearing, LPCA, 150 steps");
  EXPECT_EQ(shown_subject("all methods"), "all methods");
}

TEST(HistoryExport, HasALineAValue) {
  const TemporaryFolder folder;
  HistoryStore store = HistoryStore::open(folder.path());
  store.append(sample_night(1, 1));
  const std::string csv = history_csv(store);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 2 * 25);
  EXPECT_EQ(history_json(store, true)["nights"][0]["studies"][0]["scores"].size(), 12U);
}

}  // namespace
}  // namespace mapproof::test
