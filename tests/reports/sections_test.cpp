#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/experiment/run.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/study_counts.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/sections/variation_summary.hpp"
#include "tests/reports/section_text.hpp"
#include "tests/reports/synthetic_study.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::contains_text;
using test::synthetic_figures;
using test::synthetic_mpe;
using test::synthetic_study;
using test::table_named;
using test::words;

const MethodSetting kIsomap4{Method::kIsomap, 4};
const MethodSetting kIsomap6{Method::kIsomap, 6};

const SensorStudy& visibility(const Study& study) { return study.experiment.sensors[0]; }

SettingSummary summary_of(const Study& study, const MethodSetting& setting) {
  for (const SettingSummary& summary : summarize(study, visibility(study), 2000))
    if (summary.setting == setting) return summary;
  return {};
}

TEST(Summarize, AveragesOverRunsAndTakesLayoutsAsUnits) {
  const Study study = synthetic_study(5, 2);
  const SettingSummary summary = summary_of(study, kIsomap6);
  // The formula is linear in layout and pose, so the mean is that of the middle ones.
  const double scale = synthetic_mpe(kIsomap6, {0, 0}, 2000);
  EXPECT_NEAR(summary.mpe_m->mean, scale * (1 + 0.3 + 0.015), 1e-12);
  EXPECT_EQ(summary.mpe_m->clusters, 5);
  // Layout means are an arithmetic sequence: their deviation is .1 * sqrt(2.5).
  const double standard_error = scale * 0.1 * std::sqrt(2.5) / std::sqrt(5.0);
  EXPECT_NEAR(*summary.mpe_m->half_width, 2.77644510520 * standard_error, 1e-9);
  EXPECT_NEAR(summary.mpe_median_m, summary.mpe_m->mean, 1e-12);
  EXPECT_NEAR(summary.mpe_all_fitted_m, 0.8 * summary.mpe_m->mean, 1e-12);
}

TEST(Summarize, CountsRunsWithoutAScoreAndWithAStatus) {
  const SettingSummary summary = summary_of(synthetic_study(5, 2), kIsomap4);
  EXPECT_EQ(summary.runs, 10);
  EXPECT_EQ(summary.scored, 9);
  EXPECT_EQ(summary.with_status, 10);
}

TEST(Summarize, LeavesOutAScoreThatIsNoNumber) {
  Study study = synthetic_study(2, 1);
  for (RunRecord& record : study.runs[0].records)
    if (record.score) record.score->mpe_m = std::numeric_limits<double>::quiet_NaN();
  const SettingSummary summary = summary_of(study, kIsomap6);
  EXPECT_EQ(summary.scored, 1);
  EXPECT_FALSE(interval_of(summary.mpe_m));
}

TEST(BestOfEachMethod, IsTheParameterOfLeastMeanError) {
  const Study study = synthetic_study();
  const auto best = best_of_each_method(summarize(study, visibility(study), 2000));
  ASSERT_EQ(best.size(), 4u);
  EXPECT_EQ(best[3].setting, kIsomap6);
  EXPECT_EQ(best[2].setting.parameter, 6.0);
}

TEST(AccuracySection, ShowsThePapersValueAndTheDifference) {
  const Study study = synthetic_study();
  const Section section = accuracy_section(study, visibility(study));
  const Table& table = table_named(section, "accuracy-visibility");
  const double ours = summary_of(study, kIsomap6).mpe_m->mean;
  const Row& isomap = table.rows[3];
  EXPECT_EQ(table.columns[5].title, "Paper");
  EXPECT_EQ(std::get<NumberCell>(isomap.cells[5]).value, 0.177);
  EXPECT_NEAR(std::get<NumberCell>(isomap.cells[6]).value, 100 * (ours - 0.177) / 0.177, 1e-9);
  EXPECT_EQ(std::get<NumberCell>(isomap.cells[9]).value, 4.11);
  EXPECT_EQ(isomap.source, "visibility/isomap-K6/2000 of 10 runs");
  EXPECT_TRUE(table.rows[2].marked);  // SMACOF, kNN weights has the least error here
}

TEST(AccuracySection, HasNoPaperColumnsWhereNothingWasPublished) {
  Study study = synthetic_study();
  study.experiment.sensors[0].published.values.clear();
  const Section section = accuracy_section(study, visibility(study));
  for (const Column& column : table_named(section, "accuracy-visibility").columns)
    EXPECT_EQ(column.title.find("aper"), std::string::npos);
}

TEST(AccuracySection, NamesItsTablesAsTheExperimentDoesOrAfterTheSensor) {
  Study study = synthetic_study();
  const auto ids = [&] {
    const Section section = accuracy_section(study, visibility(study));
    std::vector<std::string> found;
    for (const Block& block : section.blocks)
      if (const auto* table = std::get_if<Table>(&block)) found.push_back(table->id);
    return found;
  };
  EXPECT_EQ(ids(), (std::vector<std::string>{"accuracy-visibility", "paper-visibility",
                                             "half-visibility", "friedman-visibility",
                                             "behind-visibility", "parameters-visibility"}));
  study.experiment.sensors[0].published.table = "table-1";
  EXPECT_EQ(ids(), (std::vector<std::string>{"table-1", "table-1-paper", "table-1-half",
                                             "friedman-visibility", "behind-visibility",
                                             "parameters-visibility"}));
}

TEST(AccuracySection, ShowsOursAtThePapersParameterToo) {
  Study study = synthetic_study();
  study.experiment.sensors[0].published.values[3].setting.parameter = 7;  // was not tried
  const Section section = accuracy_section(study, visibility(study));
  const Table& table = table_named(section, "paper-visibility");
  const Row& knn = table.rows[2];
  EXPECT_EQ(std::get<TextCell>(knn.cells[1]).text, "K = 5");
  const MethodSetting at_paper{Method::kSmacofKnn, 5};
  EXPECT_EQ(std::get<NumberCell>(knn.cells[2]).value, summary_of(study, at_paper).mpe_m->mean);
  EXPECT_EQ(knn.source, "visibility/smacof-knn-K5/2000 of 10 runs");
  EXPECT_EQ(std::get<TextCell>(knn.cells.back()).text, "no");
  const Row& isomap = table.rows[3];
  EXPECT_TRUE(std::holds_alternative<MissingCell>(isomap.cells[2]));
  EXPECT_EQ(std::get<NumberCell>(isomap.cells[4]).value, 0.177);
  EXPECT_EQ(isomap.source, "");
}

TEST(AccuracySection, LeavesOutWhatThePaperHasOfMethodsThatTheStudyHasNot) {
  Study study = synthetic_study();
  Published& published = study.experiment.sensors[0].published;
  published.values.push_back({.setting = {Method::kHessianLle, 7.0},
                              .mpe_m = 0.2,
                              .moe_percent = 5.0,
                              .note = "Of HLLE."});
  published.orderings = {{Method::kHessianLle, Method::kLle}};
  const Section section = accuracy_section(study, visibility(study));
  const Table& paper = table_named(section, "paper-visibility");
  for (const Row& row : paper.rows)
    EXPECT_NE(format_cell(row.cells[0]), std::string(info(Method::kHessianLle).label));
  EXPECT_EQ(std::ranges::count(paper.notes, "Left out, not in this study: HLLE."), 1);
  for (const Block& block : section.blocks)
    if (const auto* table = std::get_if<Table>(&block)) {
      EXPECT_FALSE(table->id.starts_with("orderings-")) << "no ordering was tried";
      EXPECT_EQ(std::ranges::count_if(
                    table->notes,
                    [](const std::string& note) { return note.find("Of HLLE") != note.npos; }),
                0);
    }
}

TEST(AccuracySection, HasOnePrecisionOfMpeForAllSensorsAndThePapersOwnDigits) {
  const Study study = synthetic_study();
  std::vector<std::string> printed;
  for (const SensorStudy& sensor : study.experiment.sensors) {
    const Section section = accuracy_section(study, sensor);
    const Table& table =
        table_named(section, fmt::format("accuracy-{}", name(sensor.sensor.sensor)));
    for (const Row& row : table.rows) {
      EXPECT_EQ(std::get<NumberCell>(row.cells[3]).decimals, 4) << table.caption;
      EXPECT_EQ(std::get<NumberCell>(row.cells[7]).decimals, 2) << table.caption;
      printed.push_back(format_cell(row.cells[5]) + " " + format_cell(row.cells[9]));
    }
  }
  EXPECT_EQ(printed,
            (std::vector<std::string>{"1.055 18.19", "0.421 5.86", "0.206 4.83", "0.177 4.11",
                                      "0.168 2.33", "0.101 1.38", "0.0609 1.00", "0.0979 1.83"}));
}

TEST(AllOverlap, IsOfMeansWhoseIntervalsHaveAValueInCommon) {
  const auto mean = [](double at, double half_width) {
    return MeanEstimate{.mean = at, .values = 9, .clusters = 3, .half_width = half_width};
  };
  EXPECT_TRUE(all_overlap({mean(0.06, 0.01), mean(0.05, 0.01)}));
  EXPECT_FALSE(all_overlap({mean(0.06, 0.01), mean(0.5, 0.01), mean(0.05, 0.01)}))
      << "the ends overlap, the middle does not";
  EXPECT_FALSE(all_overlap({mean(0.06, 0.01), std::nullopt}));
  EXPECT_FALSE(all_overlap({mean(0.06, 0.01)}));
}

TEST(VariationTable, NamesLevelsAndWarningsInWordsAndSaysARepeatedThingOnce) {
  Study study = synthetic_study();
  const std::vector<MethodSetting> settings = {{Method::kSmacofKnn, 5}, {Method::kIsomap, 6}};
  const Variation stop{.id = "stop",
                       .sensor = Sensor::kBearing,
                       .factor = Factor::kSmacofKnnFall,
                       .levels = {1e-6, 1e-4, 0.1},
                       .step = 2000,
                       .placement = std::nullopt,
                       .settings = settings};
  study.experiment.variations = {stop};
  for (auto& run : study.runs)
    for (const double level : stop.levels)
      for (const MethodSetting& setting : settings) {
        VariationRecord record{.variation = "stop",
                               .level = level,
                               .setting = setting,
                               .statuses = {},
                               .score = Score{0.1, 2.0, 0.1, 2.0}};
        if (level == 0.1 || run.id == study.runs.front().id)
          record.statuses = {status_with_message(StatusCode::kNotConverged, "")};
        run.variations.push_back(std::move(record));
      }
  const Table table = variation_table(study, stop);
  EXPECT_EQ(table.columns[2].title, "10⁻⁶");
  EXPECT_EQ(table.columns[3].title, "10⁻⁴");
  EXPECT_EQ(table.columns[4].title, "0.1");
  EXPECT_EQ(table.notes.back(),
            "SMACOF, kNN weights, K = 5; ISOMAP, K = 6: not converged in 1 of 10 runs at 10⁻⁶ and "
            "10⁻⁴, 10 at 0.1.");
}

TEST(AccuracySection, SaysWhyAPrintedValueCannotBeMatched) {
  Study study = synthetic_study();
  Published& published = study.experiment.sensors[0].published;
  published.values[0].note = "The reason.";
  published.notes = {"On all of them."};
  const Section section = accuracy_section(study, visibility(study));
  const auto& notes = table_named(section, "accuracy-visibility").notes;
  ASSERT_EQ(notes.size(), 5U);
  EXPECT_EQ(notes[3], "LPCA: The reason.");
  EXPECT_EQ(notes[4], "On all of them.");
  EXPECT_TRUE(
      contains_text(summary_section(study), "1 printed value left out of this, for reasons under "))
      << words(summary_section(study));
}

TEST(AccuracySection, SaysHowOptimisticThePapersChoiceIsAndWhyThereMayBeNoAnswer) {
  Study study = synthetic_study(4, 1);
  EXPECT_TRUE(contains_text(accuracy_section(study, visibility(study)),
                            "is optimistic: on runs that had no "))
      << words(accuracy_section(study, visibility(study)));
  study = synthetic_study(1, 1);
  EXPECT_TRUE(contains_text(accuracy_section(study, visibility(study)), "there are no two halves"));
}

TEST(AccuracySection, HoldsThePapersOrderingsAgainstTheRuns) {
  Study study = synthetic_study();
  study.experiment.sensors[0].published.orderings = {
      {Method::kSmacofKnn, Method::kIsomap, Method::kLpca}, {Method::kLpca, Method::kSmacof}};
  const Section section = accuracy_section(study, visibility(study));
  const Table& table = table_named(section, "orderings-visibility");
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(std::get<TextCell>(table.rows[0].cells[2]).text, "yes");
  EXPECT_EQ(std::get<TextCell>(table.rows[2].cells[2]).text, "no");
  EXPECT_EQ(std::get<TextCell>(table.rows[0].cells[5]).text, "5 of 5");
  EXPECT_TRUE(contains_text(summary_section(study), "2 of the paper\u2019s 3 orderings hold"))
      << words(summary_section(study));
  EXPECT_TRUE(contains_text(summary_section(study), "Not: LPCA < SMACOF, equal weights."));
}

TEST(AccuracySection, RanksTheMethodsOverLayoutsAndMarksWhatIsAlike) {
  const Study study = synthetic_study(5, 2);
  const Section section = accuracy_section(study, visibility(study));
  const Table& table = table_named(section, "friedman-visibility");
  EXPECT_EQ(std::get<TextCell>(table.rows[0].cells[0]).text, "SMACOF, kNN weights");
  EXPECT_EQ(std::get<NumberCell>(table.rows[0].cells[2]).value, 1.0);
  EXPECT_EQ(std::get<TextCell>(table.rows[1].cells[4]).text, "a, b");
  EXPECT_EQ(std::get<TextCell>(table.rows[3].cells[4]).text, "b");
  EXPECT_NE(table.notes[0].find("F is infinite, all layouts agreeing"), std::string::npos);
  EXPECT_TRUE(contains_text(accuracy_section(synthetic_study(1, 2), visibility(study)),
                            "Methods cannot be ranked by a test: 1 layout scored by 4 methods"));
}

TEST(AccuracySection, SaysThatOneLayoutGivesNoInterval) {
  const Study study = synthetic_study(1, 3);
  const Section section = accuracy_section(study, visibility(study));
  const Table& table = table_named(section, "accuracy-visibility");
  EXPECT_TRUE(std::holds_alternative<MissingCell>(table.rows[0].cells[4]));
  EXPECT_NE(table.notes[1].find("no interval"), std::string::npos);
}

TEST(SummarySection, NamesTheBestMethodOfEachSensorWithItsNumbers) {
  const Section section = summary_section(synthetic_study());
  EXPECT_TRUE(contains_text(section, "SMACOF, kNN weights, K = 6"));
  EXPECT_TRUE(contains_text(
      section,
      "Of 6 pairs of methods, 5 have the paper\u2019s order; the paper has ISOMAP < SMACOF, kNN "
      "weights."))
      << words(section);
  EXPECT_TRUE(contains_text(section,
                            "Warnings and failures: 110 of 640 maps (17\u00a0%) have warnings, "
                            "8 have no score and 8 could not be made; all are listed below."))
      << words(section);
}

TEST(SummarySection, SaysPlainlyThatNothingFailed) {
  Study study = synthetic_study(1, 1);
  std::erase_if(study.runs[0].records,
                [](const RunRecord& record) { return !record.statuses.empty(); });
  EXPECT_TRUE(contains_text(summary_section(study), "none in 53 maps"))
      << words(summary_section(study));
}

TEST(SummarySection, SaysWhenTheStudyIsSmallerThanThePapers) {
  EXPECT_TRUE(
      contains_text(summary_section(synthetic_study(5, 1)), "Not the paper\u2019s protocol"));
  EXPECT_FALSE(
      contains_text(summary_section(synthetic_study(5, 5)), "Not the paper\u2019s protocol"));
}

TEST(SummarySection, SaysWhenRunsAreMissing) {
  Study study = synthetic_study(5, 5);
  study.runs.pop_back();
  EXPECT_TRUE(contains_text(summary_section(study), "24 of 25 runs are done"));
  study.runs.resize(1);
  EXPECT_TRUE(contains_text(summary_section(study), "1 of 25 runs is done"));
}

TEST(SummarySection, CopesWithAStudyWithoutARun) {
  Study study = synthetic_study();
  study.runs.clear();
  const Section section = summary_section(study);
  EXPECT_TRUE(contains_text(section, "no map could be scored"));
  EXPECT_FALSE(contains_text(section, "ended well"));
  EXPECT_NO_THROW(accuracy_section(study, visibility(study)));
  EXPECT_NO_THROW(statuses_section(study));
}

std::string number_of(const Opening& opening, const std::string& label) {
  for (const Highlights::Item& item : opening.numbers.items)
    if (item.label.starts_with(label)) return item.value + ", " + item.detail;
  return "";
}

TEST(Opening, ShowsAFigureThatFoundSomethingFirst) {
  StudyFigures figures;
  figures.groups = {{"g",
                     "Group",
                     "",
                     {Figure{.id = "a", .title = "Hall: MPE 1 m, too few runs to rank the methods"},
                      Figure{.id = "b", .title = "Hall: SDE has the lowest MPE"}}}};
  Opening opening;
  choose_figures({"a", "b"}, figures, opening);
  EXPECT_EQ(opening.main_figure, "b");
  EXPECT_EQ(opening.figure_ids, std::vector<std::string>{"a"});
  Opening alone;
  choose_figures({"a"}, figures, alone);
  EXPECT_EQ(alone.main_figure, "a") << "if there is any";
  Opening evident;
  choose_figures({"b"}, figures, evident, {"lost", "a"});
  EXPECT_EQ(evident.main_figure, "a") << "what shows the first number, whatever it found";
  EXPECT_EQ(evident.figure_ids, std::vector<std::string>{"b"});
}

TEST(StudyOpening, BeginsWithHowThePublishedNumbersCompare) {
  Study study = synthetic_study();
  study.experiment.sensors[0].published.orderings = {
      {Method::kSmacofKnn, Method::kIsomap, Method::kLpca}, {Method::kLpca, Method::kSmacof}};
  const StudyFigures figures = synthetic_figures(study);
  const Opening opening = study_opening(study, figures);
  const Highlights::Item& orderings = opening.numbers.items.at(1);
  EXPECT_TRUE(orderings.table.starts_with("orderings-")) << orderings.label;
  int compared = 0, within = 0;
  for (const SensorStudy& sensor : study.experiment.sensors) {
    const PublishedAgreement agreement =
        agreement_of(best_of_each_method(summarize(study, sensor, last_step(sensor))));
    compared += agreement.compared;
    within += agreement.within;
  }
  ASSERT_GT(compared, 0);
  EXPECT_TRUE(opening.numbers.items[0].label.starts_with("published errors inside our 95"));
  EXPECT_TRUE(number_of(opening, "published errors")
                  .starts_with(fmt::format("{} of {}, Yairi 2007: ", within, compared)))
      << number_of(opening, "published errors");
  EXPECT_TRUE(number_of(opening, "published orderings").starts_with("2 of 3, "));
  EXPECT_NE(number_of(opening, "best MPE by visibility").find("SMACOF, kNN weights, K = 6"),
            std::string::npos);
  EXPECT_EQ(opening.main_figure, "published-errors");
}

TEST(StudyOpening, SaysWhatIsWrongWithAStudy) {
  Study study = synthetic_study(5, 5);
  study.runs.pop_back();
  const auto wrong = [&] {
    return "Warnings" + words(Section{"opening", "", {study_opening(study, {}).wrong}});
  };
  EXPECT_NE(wrong().find("Warnings: 24 of 25 runs are done."), std::string::npos) << wrong();
  EXPECT_NE(
      wrong().find(fmt::format("done. {}. Most frequent: bridged (", endings_text(count(study)))),
      std::string::npos)
      << wrong();
  EXPECT_NE(number_of(study_opening(study, {}), "of 1").find("could not be scored"),
            std::string::npos);
  EXPECT_EQ(study_opening(study, {}).warnings,
            std::vector<std::string>{endings_text(count(study))});
  study.runs.clear();
  EXPECT_TRUE(study_opening(study, {}).warnings.empty());
  EXPECT_NE(wrong().find("0 of 25 runs are done."), std::string::npos) << wrong();
}

TEST(StudyCounts, SayHowManyMapsHaveWarningsAndWhichShareTheyAre) {
  EXPECT_EQ(endings_text({.maps = 25'700, .with_status = 2310, .unscored = 50}),
            "2,310 of 25,700 maps (9\u00a0%) have warnings and 50 have no score");
  EXPECT_EQ(endings_text({.maps = 300, .with_status = 1, .unscored = 1, .failed = 1}),
            "1 of 300 maps (under 1\u00a0%) has a warning, 1 has no score and 1 could not be made");
  EXPECT_EQ(endings_text({.maps = 9658, .with_status = 9657}),
            "9657 of 9658 maps (99\u00a0%) have warnings");
  EXPECT_EQ(warned_percent({.maps = 2, .with_status = 2}), 100);
  EXPECT_EQ(warned_percent({.maps = 25'700}), 0);
}

}  // namespace
}  // namespace mapproof
