#include "reports/sections/slam/slam_report.hpp"
#include "reports/sections/slam/slam_tables.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reports/model/format.hpp"
#include "reports/sections/study_report.hpp"
#include "tests/reports/section_text.hpp"
#include "tests/reports/synthetic_study.hpp"
#include "tests/support/samples/sample_slam.hpp"

namespace mapproof {
namespace {

using test::contains_text;
using test::sample_slam_study;
using test::table_named;
using test::words;

/// Sections of a study with its figures and seconds.
std::vector<Section> sections_of(const SlamStudy& study, const SlamTimings& timings = {}) {
  const StudyFigures figures = slam_figures(study, timings);
  return slam_sections({study, {}, timings, figures, "mapproof reproduce boots2013"});
}

std::vector<std::string> ids_of(const std::vector<Section>& sections) {
  std::vector<std::string> ids;
  for (const Section& section : sections) ids.push_back(section.id);
  return ids;
}

std::vector<std::string> figure_ids(const StudyFigures& figures) {
  std::vector<std::string> ids;
  for (const Figure* figure : all_figures(figures)) ids.push_back(figure->id);
  return ids;
}

const SlamRun& plaza(const SlamStudy& study) { return study.runs[1]; }

TEST(SlamFigures, AreThePapersAndThoseBeyondItUnderTheirIds) {
  const SlamStudy study = sample_slam_study();
  EXPECT_EQ(figure_ids(slam_figures(study, test::sample_slam_timings())),
            (std::vector<std::string>{"fig-1a", "spectrum-simulation", "fig-1b", "angle-simulation",
                                      "positions-simulation", "noise-simulation", "fig-2b",
                                      "spectrum-plaza-1", "windows-plaza-1", "fig-2c",
                                      "spectrum-plaza-2", "windows-plaza-2", "lfmdr-range",
                                      "lfmdr-squared-range", "factorization-cost"}));
  const StudyFigures figures = slam_figures(study, {});
  EXPECT_TRUE(all_figures(figures)[0]->title.starts_with("Fig. 1A. "));
  EXPECT_TRUE(all_figures(figures)[2]->title.starts_with("Fig. 1B. "));
}

TEST(SlamFigures, ShowStartsOnlyIfTheyEndAtMoreThanTwoCosts) {
  SlamStudy study = sample_slam_study();
  const auto has_starts = [&] {
    return std::ranges::count(figure_ids(slam_figures(study, {})), "starts-plaza-1") == 1;
  };
  EXPECT_FALSE(has_starts()) << "All but one end at one cost, which a sentence says.";
  study.runs[1].starts.back().cost = 2000.0;
  ASSERT_TRUE(has_starts());
  const StudyFigures figures = slam_figures(study, {});
  for (const Figure* figure : all_figures(figures))
    if (figure->id == "starts-plaza-1")
      EXPECT_EQ(figure->title, "Plaza 1: 12 of 14 starts end at the same, least cost");
}

TEST(SlamFigures, HaveAQuadricForEachUpgradeTheDrivesAndTheFlightInSpace) {
  SlamStudy study = sample_slam_study();
  const auto ids = [&] {
    const StudyFigures figures = slam_figures(study, {});
    std::vector<std::string> found;
    for (const Scene* scene : all_scenes(figures)) found.push_back(scene->id);
    return found;
  };
  const std::vector<std::string> drives = {"scene-drive-plaza-1", "scene-drive-plaza-2"};
  EXPECT_EQ(ids(), (std::vector<std::string>{"scene-quadric-simulation", drives[0], drives[1],
                                             "scene-space"}));
  study.runs[1].upgrade = std::move(study.runs[0].upgrade);
  study.runs[0].upgrade.reset();
  study.runs[1].upgrade->before.points(0, 0) = 1e300;
  study.space.reset();
  EXPECT_EQ(ids(), drives);
}

TEST(SlamReport, TellsTheErrorsOfAFlightInSpaceAndItsStatuses) {
  SlamStudy study = sample_slam_study();
  SpaceRecord& record = study.space->records[1];
  record.estimate.statuses = {status_with_message(StatusCode::kUndetermined, "Another fits.")};
  record.landmarks_error_m.reset();
  const std::vector<Section> sections = sections_of(study);
  const auto section = std::ranges::find(sections, "slam-space", &Section::id);
  ASSERT_NE(section, sections.end());
  const Table& table = table_named(*section, "slam-space");
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(std::get<NumberCell>(table.rows[0].cells[1]).value, 0.05);
  EXPECT_TRUE(std::holds_alternative<MissingCell>(table.rows[1].cells[1]));
  const auto statuses = std::ranges::find(sections, "slam-warnings", &Section::id);
  const auto& list = std::get<StatusList>(statuses->blocks.back());
  EXPECT_TRUE(std::ranges::any_of(list.items, [](const StatusList::Item& item) {
    return item.where == "in space, no landmark known" && item.code == "undetermined";
  }));
}

TEST(SlamFigures, HaveTheTenMethodsAndTheSpectralMapOnOneWall) {
  const StudyFigures figures = slam_figures(sample_slam_study(), {});
  for (const Figure* figure : all_figures(figures))
    if (figure->id.starts_with("lfmdr-")) {
      EXPECT_EQ(figure->panels.size(), 11u);
      const std::string spectral =
          figure->id == "lfmdr-range" ? "Spectral, squared ranges\n" : "Spectral\n";
      EXPECT_TRUE(std::ranges::any_of(
          figure->panels, [&](const Panel& each) { return each.title.starts_with(spectral); }));
      EXPECT_EQ(figure->caption.find("anchors"), std::string::npos) << "They have none.";
    }
}

TEST(SlamFigures, OfRangesNameTheBestMethodOnRangesThoughTheSpectralMapIsBetter) {
  SlamStudy study = sample_slam_study();
  for (RangeHistoryMap& map : study.histories->maps)
    if (map.score) map.score->mpe_all_fitted_m = map.setting ? 0.5 : 0.01;
  const StudyFigures figures = slam_figures(study, {});
  for (const Figure* figure : all_figures(figures)) {
    if (figure->id == "lfmdr-range") {
      EXPECT_TRUE(figure->title.ends_with(" has the lowest error, 0.500 m")) << figure->title;
      EXPECT_EQ(figure->title.find("Spectral"), std::string::npos) << figure->title;
    }
    if (figure->id == "lfmdr-squared-range")
      EXPECT_EQ(figure->title, "On squared ranges Spectral has the lowest error, 0.0100 m");
  }
}

TEST(SlamFigures, OfAPathInThreeDimensionsHaveATitleOfTheirOwn) {
  const StudyFigures figures = slam_figures(sample_slam_study(), {});
  for (const Scene* scene : all_scenes(figures))
    if (scene->id == "scene-drive-plaza-1") {
      EXPECT_EQ(scene->title,
                "Plaza 1, in 3-D: the path coloured by its error, 0.123 m on average");
    }
}

TEST(SlamFigures, LeaveOutWhatTheStudyDoesNotHold) {
  SlamStudy study = sample_slam_study();
  study.runs.erase(study.runs.begin());
  study.runs.pop_back();
  study.runs[0].windows.reset();
  study.runs[0].starts.clear();
  study.runs[0].figure.clear();
  study.convergence.clear();
  study.histories.reset();
  EXPECT_EQ(figure_ids(slam_figures(study, {})),
            (std::vector<std::string>{"path-plaza-1", "spectrum-plaza-1"}));
}

TEST(SlamSections, StandInOrderAndBesideThoseOfTheOtherPaper) {
  const SlamStudy study = sample_slam_study();
  const SlamTimings timings = test::sample_slam_timings();
  const StudyFigures figures = slam_figures(study, timings);
  const auto sessions = test::synthetic_sessions();
  Report report = slam_report({study, sessions, timings, figures, "mapproof reproduce all"});
  EXPECT_EQ(
      ids_of(report.sections),
      (std::vector<std::string>{"slam-summary", "slam-accuracy", "slam-run-plaza-1",
                                "slam-run-plaza-2", "slam-simulation", "slam-histories",
                                "slam-space", "slam-cost", "slam-warnings", "slam-provenance"}));
  EXPECT_NO_THROW(check(report));
  const Study other = test::synthetic_study(2, 1);
  const StudyFigures other_figures = test::synthetic_figures(other);
  const auto other_timings = test::synthetic_timings(other);
  const Report first = study_report({other, sessions, other_timings, other_figures, "x"});
  report.sections.insert(report.sections.begin(), first.sections.begin(), first.sections.end());
  EXPECT_NO_THROW(check(report));
}

TEST(SlamSummary, BeginsWithWhatIsMissingAndHowToGetIt) {
  SlamStudy study = sample_slam_study();
  study.experiment.data = {{.id = "plaza-1"},
                           {.id = "plaza-3",
                            .title = "Plaza 3",
                            .source = "Give the folder of the Plaza data with --plaza."}};
  const Section section = slam_summary_section(study);
  const auto* callout = std::get_if<Callout>(&section.blocks.front());
  ASSERT_NE(callout, nullptr);
  EXPECT_EQ(callout->tone, Callout::Tone::kWarning);
  EXPECT_TRUE(contains_text(section,
                            "Plaza 3 is missing. Give the folder of the Plaza data with --plaza."));
  EXPECT_EQ(std::get_if<Callout>(&slam_summary_section(sample_slam_study()).blocks.front()),
            nullptr);
}

TEST(SlamSummary, FindsErrorsWithTheirAlignmentScaleAndStarts) {
  const Section section = slam_summary_section(sample_slam_study());
  EXPECT_TRUE(contains_text(section,
                            "Plaza 1: mean position error 0.123 m for refined, scale free (rigid), "
                            "0.411 m for spectral, 4-D (rigid)"))
      << words(section);
  EXPECT_TRUE(contains_text(section, "dead reckoning (unaligned)"));
  EXPECT_TRUE(contains_text(section, "Its ranges are 6.6 % too long"));
  EXPECT_TRUE(contains_text(section,
                            "1 of 1 from the spectral answer, 1 of 1 from dead reckoning and 11 of "
                            "12 from random landmarks"));
  EXPECT_TRUE(contains_text(section, "to the power \u22120.50 ("));
  EXPECT_TRUE(contains_text(section, "; a line through 7 means, without an interval); theory"));
  EXPECT_TRUE(contains_text(section, "Fig. 2A is a photograph"));
}

std::string words(const Opening& opening) {
  std::string all;
  for (const Highlights::Item& number : opening.numbers.items)
    all += fmt::format("{} {} ({}). ", number.value, number.label, number.detail);
  for (const Paragraph& finding : opening.findings)
    for (const Phrase& phrase : finding.phrases) all += phrase.text;
  for (const Phrase& phrase : opening.wrong.phrases) all += " Warnings" + phrase.text;
  for (const Phrase& phrase : opening.compared_with.phrases) all += " Compared with" + phrase.text;
  return all;
}

TEST(SlamOpening, IsAFewNumbersAndWhatTheyCompareWith) {
  const SlamStudy study = sample_slam_study();
  const Opening opening = slam_opening(study, slam_figures(study, {}));
  const std::string all = words(opening);
  EXPECT_TRUE(
      all.starts_with("0.123 m mean position error, Plaza 1 (refined, scale free (rigid); "
                      "dead reckoning "))
      << all;
  EXPECT_NE(all.find("m (unaligned); spectral, 4-D 0.411 m (rigid); over "), std::string::npos)
      << all;
  EXPECT_NE(all.find("power of the measurements in the model error"), std::string::npos) << all;
  EXPECT_NE(all.find("theory: \u22121/2"), std::string::npos) << all;
  EXPECT_NE(all.find("2 recorded drives"), std::string::npos) << all;
  EXPECT_EQ(opening.main_figure, "fig-2b");
  EXPECT_LT(all.size(), 1330U) << all;
  EXPECT_EQ(opening.numbers.items.front().table,
            std::get<Table>(slam_accuracy_section(study).value().blocks.front()).id)
      << "where the error is seen";
}

TEST(SlamOpening, SaysOnItsTileWhatTheSlopeRestsOn) {
  SlamStudy study = sample_slam_study();
  const auto detail = [&] {
    for (const Highlights::Item& item : slam_opening(study, {}).numbers.items)
      if (item.label.starts_with("power of the measurements")) return item.detail;
    return std::string();
  };
  EXPECT_EQ(detail(), "theory: \u22121/2; a line through 7 means");
  study.convergence.push_back(test::sample_convergence("plain", "plain SVD", 1.0));
  study.experiment.convergence = ConvergenceOptions{};
  EXPECT_EQ(detail(),
            "theory: \u22121/2; a line through 7 means; as in the paper, with the noise\u2019s "
            "variance left in, \u22120.50");
  study.experiment.name = "other";
  study.convergence.front().points.resize(3);
  EXPECT_EQ(detail(), "theory: \u22121/2; a line through 3 means");
}

TEST(SlamOpening, NamesTheBestEstimateAndByHowMuch) {
  SlamStudy study = sample_slam_study();
  SlamRun& run = study.runs[1];
  run.records.push_back(run.records[5]);
  run.records.back().method = SlamMethod::kRefinedFromOdometry;
  const auto set_mean = [&](SlamMethod method, double mean_m) {
    std::ranges::find(run.records, method, &SlamRecord::method)->errors.front().mean_m = mean_m;
  };
  set_mean(SlamMethod::kSpectral, 0.42);
  set_mean(SlamMethod::kRefined, 0.25);
  set_mean(SlamMethod::kRefinedFromOdometry, 0.19);
  set_mean(SlamMethod::kSpectralKnown, 0.01);  // Was given landmarks.
  const auto text = [&] { return words(slam_opening(study, {})); };
  EXPECT_NE(text().find("Best by mean position error. Plaza 1: refined (from odometry) 0.190 m; "
                        "refined (scale free) 0.250 m; spectral (4-D) 0.420 m."),
            std::string::npos)
      << text();
  EXPECT_NE(text().find("0.250 m mean position error, Plaza 1 (refined, scale free (rigid); least: "
                        "refined, from odometry 0.190 m (rigid); dead reckoning"),
            std::string::npos)
      << text();
  EXPECT_EQ(text().find("chosen without"), std::string::npos) << "The paper's figures.";
  run.figure.clear();
  EXPECT_NE(text().find("0.420 m. Its figures show refined (scale free), which was chosen without "
                        "the ground truth."),
            std::string::npos)
      << text();
  set_mean(SlamMethod::kRefinedFromOdometry, 0.25);
  EXPECT_EQ(text().find("chosen without"), std::string::npos) << text();
  EXPECT_NE(text().find("Plaza 1: refined (scale free) and refined (from odometry) 0.250 m; "),
            std::string::npos)
      << text();
}

TEST(SlamOpening, WithoutDrivesShowsHowErrorsConverge) {
  SlamStudy study = sample_slam_study();
  std::erase_if(study.runs, [](const SlamRun& run) { return !run.simulated; });
  const Opening opening = slam_opening(study, slam_figures(study, {}));
  EXPECT_EQ(opening.main_figure, "fig-1b");
  EXPECT_EQ(words(opening).find("recorded"), std::string::npos) << words(opening);
  for (const char* absent : {"dead reckoning", "extended Kalman filter"})
    EXPECT_EQ(words(opening).find(absent), std::string::npos) << words(opening);
  EXPECT_NE(words(opening).find("Compared with: theory"), std::string::npos) << words(opening);
}

TEST(SlamOpening, ComparesADriveWithItsGroundTruthAndOtherMethodsOrWithNothing) {
  SlamStudy study;
  study.experiment.name = "slam";
  study.runs = {test::sample_drive("mine", 100, 1)};
  const auto compared = [&] { return slam_opening(study, {}).compared_with.phrases.at(0).text; };
  EXPECT_TRUE(compared().starts_with(": the ground truth, dead reckoning")) << compared();
  study.runs[0].log.ground_truth.reset();
  study.runs[0].log.true_landmarks.reset();
  EXPECT_EQ(compared(), ": nothing; the log has no ground truth.");
}

TEST(SlamOpening, CountsMissingLogsAsWarningsThatTheirSectionLists) {
  SlamStudy study = sample_slam_study();
  std::erase_if(study.runs, [](const SlamRun& run) { return !run.simulated; });
  study.experiment.data = {{.id = "plaza-1", .title = "Plaza 1", .source = "Fetch one."},
                           {.id = "plaza-2", .title = "Plaza 2", .source = "Fetch two."}};
  const auto tile = [&] { return slam_opening(study, {}).numbers.items.back(); };
  const Highlights::Item with_both = tile();
  EXPECT_TRUE(with_both.falls_short);
  EXPECT_TRUE(with_both.detail.starts_with("the logs of Plaza 1 and Plaza 2 are missing"))
      << with_both.detail;
  EXPECT_NE(words(slam_opening(study, {})).find("the half of the paper on real data"),
            std::string::npos);
  EXPECT_TRUE(contains_text(slam_statuses_section(study), "Plaza 1 is missing. Fetch one."));
  study.experiment.data.pop_back();
  EXPECT_EQ(std::stoi(tile().value) + 1, std::stoi(with_both.value));
}

TEST(SlamOpening, OfNothingSaysNothing) { EXPECT_EQ(words(slam_opening({}, {})), ""); }

TEST(SlamSummary, ClaimsNoErrorWithoutAGroundTruthAndNothingOfAPaperThatIsNot) {
  SlamStudy study;
  study.experiment.name = "slam";
  study.runs = {test::sample_drive("mine", 100, 1)};
  SlamRun& run = study.runs[0];
  run.log.ground_truth.reset();
  run.log.true_landmarks.reset();
  run.starts.clear();
  for (SlamRecord& record : run.records) record.errors.clear(), record.error_m.clear();
  std::string all;
  for (const Section& section : sections_of(study)) all += words(section);
  EXPECT_NE(all.find("no error claimed"), std::string::npos) << all;
  EXPECT_EQ(all.find("mean position error"), std::string::npos) << all;
  EXPECT_EQ(all.find("paper"), std::string::npos) << all;
}

TEST(SlamErrorTable, HasARowAMethodWithItsAlignmentAndMarksTheBestRigidOne) {
  const SlamStudy study = sample_slam_study();
  const auto section = slam_accuracy_section(study).value();
  const Table& table = table_named(section, "table-plaza");
  ASSERT_EQ(table.rows.size(), plaza(study).records.size() + study.runs[2].records.size());
  EXPECT_EQ(table.columns[3].title, "Alignment");
  const Row& dead = table.rows[0];
  EXPECT_EQ(std::get<TextCell>(dead.cells[1]).text, "dead reckoning (baseline)");
  EXPECT_EQ(std::get<TextCell>(dead.cells[2]).text, "none");
  EXPECT_EQ(std::get<TextCell>(dead.cells[3]).text, "unaligned");
  EXPECT_EQ(std::get<NumberCell>(dead.cells[4]).value, plaza(study).records[0].errors[0].mean_m);
  EXPECT_EQ(std::get<TextCell>(table.rows[2].cells[2]).text, "4 landmarks");
  EXPECT_EQ(std::get<NumberCell>(table.rows[5].cells.back()).value, 1.066);
  EXPECT_TRUE(table.rows[5].marked);
  EXPECT_EQ(std::ranges::count(table.rows, true, &Row::marked), 2);
  EXPECT_EQ(table.rows[5].source, "plaza-1/refined");
  EXPECT_TRUE(table.notes[1].starts_with("Marked: ")) << "where a row is marked";
  SlamRun mirrored = study.runs[0];
  for (SlamRecord& record : mirrored.records)
    record.errors.front().alignment = Alignment::kRigidWithReflection;
  const std::vector<const SlamRun*> walk = {&mirrored};
  for (const std::string& note : slam_error_table("walk", "Methods", walk).notes)
    EXPECT_FALSE(note.starts_with("Marked: ")) << "no path is aligned rigidly";
}

TEST(SlamErrorTable, SaysWhyRefinedErrorsDifferFromThoseOfTheOtherCommand) {
  SlamRun run = plaza(sample_slam_study());
  const auto note = [&] {
    const std::vector<const SlamRun*> runs = {&run};
    return slam_error_table("e", "Methods", runs).notes.back();
  };
  EXPECT_TRUE(note().starts_with("Refined: without constant errors")) << note();
  run.fit = Fit{};
  EXPECT_FALSE(note().starts_with("Refined")) << "Known landmarks tie it: " << note();
  run.known.clear();
  EXPECT_NE(note().find("the map of the test of the fit"), std::string::npos) << note();
  std::erase_if(run.records,
                [](const SlamRecord& one) { return one.method == SlamMethod::kRefined; });
  EXPECT_FALSE(note().starts_with("Refined")) << note();
}

TEST(SlamErrorTable, KeepsARowForAMethodThatGaveNothing) {
  SlamStudy study = sample_slam_study();
  study.runs[1].records[5].errors.clear();
  const auto section = slam_accuracy_section(study).value();
  const Table& table = table_named(section, "table-plaza");
  for (std::size_t i = 3; i < 10; ++i)
    EXPECT_TRUE(std::holds_alternative<MissingCell>(table.rows[5].cells[i])) << i;
  EXPECT_FALSE(table.rows[5].marked);
  EXPECT_TRUE(table.rows[3].marked);  // Now the spectral one is the best.
}

TEST(SlamAlignmentTable, ShowsTheOtherAlignmentsAlone) {
  const SlamStudy study = sample_slam_study();
  const std::vector<const SlamRun*> runs = {&study.runs[1]};
  const Table table = slam_alignment_table(runs).value();
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(std::get<TextCell>(table.rows[0].cells[2]).text, "similarity");
  const std::vector<const SlamRun*> walk = {&study.runs[0]};
  EXPECT_FALSE(slam_alignment_table(walk));
}

TEST(SlamDriveTable, HasThePapersNumbersOnlyWhereItPrintsThem) {
  SlamStudy study = sample_slam_study();
  study.runs[2].published.reset();
  const std::vector<const SlamRun*> both = {&study.runs[1], &study.runs[2]};
  const Table table = slam_drive_table(both);
  ASSERT_EQ(table.columns.size(), 8u);
  EXPECT_EQ(std::get<NumberCell>(table.rows[0].cells[6]).value, 9658.0);
  EXPECT_TRUE(std::holds_alternative<MissingCell>(table.rows[1].cells[6]));
  EXPECT_EQ(std::get<NumberCell>(table.rows[0].cells[3]).value, 2000.0);
  const std::vector<const SlamRun*> last = {&study.runs[2]};
  EXPECT_EQ(slam_drive_table(last).columns.size(), 5u);
}

TEST(SlamLandmarkTable, ShowsTheRefinedMapWithItsDeviationsAndErrors) {
  const SlamStudy study = sample_slam_study();
  const Table table = slam_landmark_table(plaza(study)).value();
  EXPECT_EQ(table.caption, "Landmarks, refined, scale free");
  ASSERT_EQ(table.columns.size(), 8u);
  EXPECT_NEAR(std::get<NumberCell>(table.rows[0].cells[3]).value, 0.05, 1e-12);
  EXPECT_NEAR(std::get<NumberCell>(table.rows[0].cells[7]).value, 0.4 * 0.12 * std::sqrt(2.0),
              1e-9);
}

TEST(SlamSimulationSection, TellsTheMisprintOfEquationFive) {
  const SlamStudy study = sample_slam_study();
  const StudyFigures figures = slam_figures(study, {});
  const Section section = slam_simulation_section(study, &figures.groups[0]).value();
  EXPECT_TRUE(contains_text(section, "\u00D5(1/\u03B6\u00B2)")) << words(section);
  const Table& table = table_named(section, "slam-convergence");
  EXPECT_EQ(table.rows.size(), 14u);
  EXPECT_EQ(std::get<NumberCell>(table.rows[0].cells[1]).value, 300.0);
}

TEST(SlamHistoryTable, HoldsRangesBesideSquaredRangesAndTheSpectralMapLast) {
  const Table table = slam_history_table(test::sample_histories());
  ASSERT_EQ(table.rows.size(), 11u);
  EXPECT_TRUE(std::holds_alternative<MissingCell>(table.rows[8].cells[1]));  // Failed on ranges.
  EXPECT_TRUE(std::holds_alternative<NumberCell>(table.rows[8].cells[3]));
  EXPECT_EQ(std::get<TextCell>(table.rows[10].cells[0]).text, "Spectral, no landmark known");
  EXPECT_TRUE(std::holds_alternative<MissingCell>(table.rows[10].cells[1]));
}

TEST(SlamHistoryTable, NamesTheParameterOfSquaredRangesWhereItDiffers) {
  RangeHistoryStudy study = test::sample_histories();
  for (RangeHistoryMap& map : study.maps)
    if (map.setting && map.setting->method == Method::kKpcaGaussian)
      map.setting->parameter = map.squared ? 500.0 : 20.0;
  const Table table = slam_history_table(study);
  std::vector<std::string> labels;
  for (const Row& row : table.rows) labels.push_back(std::get<TextCell>(row.cells[0]).text);
  EXPECT_EQ(std::ranges::count(labels,
                               "KPCA, Gaussian, \u03C3\u00B2 = 20; squared ranges: "
                               "\u03C3\u00B2 = 500"),
            1);
  EXPECT_EQ(std::ranges::count_if(
                labels, [](const std::string& label) { return label.find(';') != label.npos; }),
            1);
}

TEST(SlamStatuses, ListEachWithItsPlaceFailuresFirst) {
  const Section section = slam_statuses_section(sample_slam_study());
  const auto& list = std::get<StatusList>(section.blocks.front());
  ASSERT_EQ(list.items.size(), 3u);
  EXPECT_TRUE(list.items[0].failed);
  EXPECT_EQ(list.items[1].where, "Plaza 1, extended Kalman filter");
  EXPECT_EQ(list.items[1].locations[0].record_id, "plaza-1/ekf");
}

TEST(SlamReport, ShowsRemarksOfReadersAndMarksSecondsAsVarying) {
  const SlamStudy study = sample_slam_study();
  const auto sections = sections_of(study, test::sample_slam_timings());
  EXPECT_TRUE(
      contains_text(sections[2], "Heading increments of the table DR are the ground truth\u2019s"));
  const Table& seconds = table_named(sections[7], "slam-seconds");
  EXPECT_EQ(seconds.rows.size(), 3u);
  EXPECT_TRUE(seconds.caption.ends_with("(varies)"));
}

TEST(SlamSecondsTable, HasTheUnitAndTheDigitsThatItsTimesNeed) {
  const SlamStudy study = sample_slam_study();
  const auto shown = [&](const std::vector<double>& seconds) {
    std::vector<SlamTiming> timings;
    for (const double time : seconds)
      timings.push_back({study.runs[1].id, SlamMethod::kRefined, time});
    const Table table = *slam_seconds_table(study, timings);
    std::string text = table.columns[2].unit;
    for (const Row& row : table.rows) text += " " + format_cell(row.cells[2]);
    return text;
  };
  EXPECT_EQ(shown({0.0082, 0.4}), "ms 8.2 400.0");
  EXPECT_EQ(shown({0.016, 0.4, 0.00002}), "ms 16.0 400.0 < 0.1");
  EXPECT_EQ(shown({0.016, 0.4}), "ms 16 400");
  EXPECT_EQ(shown({2.5, 12.0}), "s 2.5 12.0");
  EXPECT_EQ(shown({0.0002, 12.0}), "s < 0.001 12.000");
}

TEST(SlamSecondsTable, SaysWhatTheFitIncludes) {
  SlamStudy study = sample_slam_study();
  const std::vector<SlamTiming> timings = {{study.runs[1].id, SlamMethod::kRefined, 0.5}};
  const auto notes = [&] { return slam_seconds_table(study, timings)->notes; };
  EXPECT_EQ(notes().size(), 2U);
  study.runs[1].fit = Fit{};
  ASSERT_EQ(notes().size(), 3U);
  EXPECT_EQ(notes()[1],
            "Where the fit was tested, refined (scale free) also estimates the noise, which the "
            "other methods take from it.");
}

TEST(SlamReport, WritesTheNameOfALogAsItIs) {
  SlamStudy study = sample_slam_study();
  study.runs[1].log.name = "plaza1";
  const SlamTimings timings;
  const StudyFigures figures = slam_figures(study, timings);
  const Report report = slam_report({study, {}, timings, figures, ""});
  const auto section = std::ranges::find(report.sections, "slam-run-plaza-1", &Section::id);
  ASSERT_NE(section, report.sections.end());
  EXPECT_EQ(section->title, "plaza1");
  EXPECT_EQ(report.sections.front().title, "Summary");
}

TEST(SlamReport, OfNothingIsAReport) {
  const SlamStudy study;
  const SlamTimings timings;
  const StudyFigures figures = slam_figures(study, timings);
  const Report report = slam_report({study, {}, timings, figures, ""});
  EXPECT_NO_THROW(check(report));
  EXPECT_EQ(ids_of(report.sections),
            (std::vector<std::string>{"slam-summary", "slam-warnings", "slam-provenance"}));
}

}  // namespace
}  // namespace mapproof
