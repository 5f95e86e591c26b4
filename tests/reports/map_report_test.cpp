#include "reports/sections/map_report.hpp"

#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "render/figures/diagrams/fit.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/fit_section.hpp"
#include "tests/reports/section_text.hpp"

namespace mapproof {
namespace {

/// Three landmarks: right, 3-4-5 off, not mapped.
MapRecord triangle() {
  MapRecord record;
  record.id = "map/isomap-K4/10";
  record.origin = FromSensor{Sensor::kBearing, {Method::kIsomap, 4}};
  record.step = 10;
  record.names = {"a", "b", "c"};
  record.estimate.resize(3, 2);
  record.estimate << 0, 0, 3, 4, kNaN, kNaN;
  record.ground_truth_m = Points(3, 2);
  *record.ground_truth_m << 0, 0, 0, 0, 1, 1;
  record.anchors = {0};
  record.statuses = {status_with_message(StatusCode::kLandmarkUnseen, "1 landmark: c.")};
  return record;
}

Report report_of(const MapRecord& record,
                 const std::optional<Highlights::Item>& fit_number = std::nullopt) {
  return map_report({record,
                     "Map of x.csv",
                     {{"File", "x.csv"}},
                     {"line 7: row dropped"},
                     {},
                     {"map", "t", "c", "a", {record.id}},
                     {},
                     {"0.1.0", "abc", "d", {}},
                     "mapproof map",
                     {},
                     {},
                     {},
                     fit_number});
}

Section warnings_of(const Report& report) {
  return *std::ranges::find(report.sections, "warnings", &Section::id);
}

const Table& landmarks(const Report& report) { return *tables(report).back(); }

TEST(MapReport, GivesEachLandmarkItsErrorAndAnUnmappedOneADash) {
  const Report report = report_of(triangle());
  check(report);
  const Table& table = landmarks(report);
  EXPECT_EQ(table.columns[5].title, "Error");
  EXPECT_NEAR(std::get<NumberCell>(table.rows[1].cells[5]).value, 5.0, 1e-12);
  EXPECT_TRUE(std::isnan(std::get<NumberCell>(table.rows[2].cells[1]).value));
  EXPECT_EQ(std::get<TextCell>(table.rows[0].cells[6]).text, "yes");
}

TEST(MapReport, JudgesTheMapByItsFitAndItsErrorBesideItsSize) {
  MapRecord record = triangle();
  const Fit fit{.verdict = FitVerdict::kDoesNotFit,
                .tests = {{.code = FitCode::kResiduals, .statistic = 9.0, .bound = 4.0},
                          {.code = FitCode::kOutliers, .statistic = 1.0, .bound = 4.0}}};
  const Highlights::Item number = fit_number(fit);
  EXPECT_EQ(number.value, "does not fit");
  EXPECT_EQ(number.detail, "1 of 2 tests beyond what noise explains");
  EXPECT_TRUE(number.falls_short);
  const std::vector<Highlights::Item> numbers = report_of(record).opening.numbers.items;
  EXPECT_TRUE(numbers.front().detail.starts_with("map of 3.0 m by 4.0 m; "))
      << numbers.front().detail;
  EXPECT_EQ(report_of(record, number).opening.numbers.items.front().value, number.value)
      << "without errors it is the first";
  record.score = Score{0.219, 4.7, 0.2, 4.7};
  const std::vector<Highlights::Item> of_score = report_of(record).opening.numbers.items,
                                      of_both = report_of(record, number).opening.numbers.items;
  const auto at = std::ranges::find(of_both, number.value, &Highlights::Item::value);
  const auto errors = std::ranges::count_if(of_score, [](const Highlights::Item& item) {
    return item.label == "MPE" || item.label == "MOE";
  });
  EXPECT_EQ(errors, 2);
  EXPECT_EQ(at - of_both.begin(), errors) << "behind the errors";
  EXPECT_EQ(of_both.size(), of_score.size() + 1);
}

TEST(FitFigure, TitleCountsTheTestsThatExceedTheirBounds) {
  const FitTest above{.code = FitCode::kResiduals, .statistic = 9.0, .bound = 4.0},
      within{.code = FitCode::kOutliers, .statistic = 1.0, .bound = 4.0};
  const auto title = [](const std::vector<FitTest>& tests) {
    return fit_figure({.verdict = FitVerdict::kFits, .tests = tests}, "fit", {}).title;
  };
  EXPECT_EQ(title({above, within}), "1 of 2 tests of the fit exceeds its bound");
  EXPECT_EQ(title({above, above}), "2 of 2 tests of the fit exceed their bounds");
  EXPECT_EQ(title({within, within}), "All 2 tests of the fit are within their bounds");
  EXPECT_EQ(title({within}), "The test of the fit is within its bound");
  EXPECT_EQ(title({above}), "1 of 1 test of the fit exceeds its bound");
}

TEST(FitFigure, HasTheGreatestTestFirstAndMarksOfTheirOwnForThoseOffItsAxis) {
  std::vector<FitTest> tests(20, {.code = FitCode::kResiduals, .bound = 4.0});
  tests[3].statistic = 1.0;
  tests[7].statistic = 9.0;
  const Figure figure = fit_figure({.verdict = FitVerdict::kFits, .tests = tests}, "fit", {});
  std::vector<Scatter> marks;
  for (const Layer& layer : figure.panels.at(0).layers)
    if (const auto* points = std::get_if<Scatter>(&layer)) marks.push_back(*points);
  ASSERT_EQ(marks.size(), 3U);
  EXPECT_EQ(marks[0].label, "below 0.03, off the axis");
  EXPECT_EQ(marks[0].x.size(), 14U);
  EXPECT_NE(marks[0].marker, marks[1].marker);
  EXPECT_EQ(marks[1].y, std::vector<double>{14.0}) << "second from above";
  EXPECT_EQ(marks[2].y, std::vector<double>{15.0}) << "the greatest, uppermost";
  ASSERT_EQ(figure.notes.size(), 3U);
  EXPECT_EQ(figure.notes[1].text, "The 16 greatest of 20 tests.");
  EXPECT_EQ(figure.notes[2].text,
            "14 statistics below 0.03 of the bound: drawn at the axis as triangles.");
}

TEST(FitFigure, ExplainsATestOfConnections) {
  const auto caption = [](FitCode code) {
    return fit_figure({.tests = {{.code = code, .bound = 1.0}}}, "fit", {}).caption;
  };
  EXPECT_NE(caption(FitCode::kWeakBridge).find("Connection: "), std::string::npos);
  EXPECT_EQ(caption(FitCode::kStress).find("Connection: "), std::string::npos);
}

TEST(FitResiduals, SayWhereThoseBeyondTheAxisAreDrawn) {
  std::vector<FittedRange> ranges(2);
  const std::vector<std::string> landmarks = {"a"};
  const auto caption = [&] {
    return fit_residuals_figure({.id = "fit",
                                 .title = "Fit",
                                 .ranges = ranges,
                                 .landmarks = landmarks,
                                 .verdict = "The data fit the map.",
                                 .is_alarm = false,
                                 .record_id = "x"})
        .caption;
  };
  EXPECT_EQ(caption().find("are drawn at"), std::string::npos);
  ranges[1].normalised = -7.0;
  EXPECT_NE(caption().find("Residuals of more than 6 standard deviations are drawn at 6"),
            std::string::npos);
}

TEST(FitResiduals, CountTheRangesBeyondThreeSigma) {
  std::vector<FittedRange> ranges(5);
  ranges[1].normalised = 3.1;
  ranges[3].normalised = -4.0;
  ranges[4].normalised = kNaN;
  EXPECT_EQ(far_residuals_text(ranges), "2 of 5 ranges beyond 3 sigma");
}

TEST(MapReport, OpensWithTheFitUnlessErrorsAreKnown) {
  MapRecord record = triangle();
  const Fit fit{.verdict = FitVerdict::kFits,
                .tests = {{.code = FitCode::kResiduals, .statistic = kNaN, .bound = 4.0}}};
  MapReportInput input{.record = record,
                       .title = "Map",
                       .facts = {},
                       .remarks = {},
                       .figure = {"map", "t", "c", "a", {record.id}},
                       .more_figures = {},
                       .provenance = {"0.1.0", "abc", "d", {}},
                       .command = "mapproof map",
                       .fit_number = fit_number(fit)};
  const auto labels = [&] {
    std::vector<std::string> all;
    for (const Highlights::Item& item : map_report(input).opening.numbers.items)
      all.push_back(item.label);
    return all;
  };
  EXPECT_EQ(labels().at(0), "the map to its data");
  EXPECT_EQ(input.fit_number->detail, "0 of 1 test beyond what noise explains");  // Not known.
  record.score = Score{0.2, 4.7, kNaN, kNaN};
  ASSERT_GE(labels().size(), 3u);
  EXPECT_EQ(labels().at(0), "MPE");
  EXPECT_EQ(labels().at(2), "the map to its data");
}

TEST(MapReport, SaysThatAnAnchorIsFarOffThoughTheDataFit) {
  MapRecord record = triangle();
  const auto anchor_item = [&] {
    for (const Highlights::Item& item : report_of(record).opening.numbers.items)
      if (item.label.starts_with("greatest distance of an anchor")) return item;
    return Highlights::Item{};
  };
  EXPECT_FALSE(anchor_item().falls_short);
  EXPECT_EQ(with_anchors("The data fit the map.", record), "The data fit the map.");
  record.anchors = {0, 1};
  (*record.ground_truth_m)(1, 0) = 3.0;
  (*record.ground_truth_m)(1, 1) = 3.5;
  EXPECT_TRUE(anchor_item().falls_short);  // 0.5 m in a map of 4 m.
  EXPECT_EQ(with_anchors("The data fit the map.", record),
            "The data fit the map. But the map misses the given position of anchor b by 0.500 m, "
            "12\u00a0% of its longer side.");
  const Report report = report_of(record);
  EXPECT_EQ(report.opening.numbers.items.front().label, anchor_item().label);
  record.statuses.clear();
  const Highlights::Item warnings = report_of(record).opening.numbers.items.back();
  EXPECT_EQ(warnings.value, "1");
  EXPECT_EQ(warnings.detail, "the map misses the given position of anchor b by 0.500 m");
  EXPECT_EQ(warnings.section, "warnings");
  EXPECT_TRUE(test::contains_text(warnings_of(report_of(record)),
                                  "The map misses the given position of anchor b by 0.500 m."));
}

TEST(MapReport, CountsTheWarningsOfItsFirstScreen) {
  MapReportInput input{.record = triangle(),
                       .title = "Map",
                       .facts = {},
                       .remarks = {},
                       .warnings = {"one", "two"},
                       .figure = {"map", "t", "c", "a", {}},
                       .more_figures = {},
                       .provenance = {"0.1.0", "abc", "d", {}},
                       .command = "mapproof map"};
  const Highlights::Item warnings = map_report(input).opening.numbers.items.back();
  EXPECT_EQ(warnings.value, "3") << "two of the command, one of the map";
  EXPECT_EQ(warnings.detail, "listed with their reasons");
  const Section listed = warnings_of(map_report(input));
  for (const char* warning : {"one", "two"})
    EXPECT_TRUE(test::contains_text(listed, warning)) << warning;
}

TEST(MapReport, SaysWhatTheMapIsComparedWith) {
  MapRecord record = triangle();
  const auto compared = [&] { return report_of(record).opening.compared_with.phrases.at(0).text; };
  EXPECT_EQ(compared(), ": the true positions of 2 landmarks that are not anchors.");
  record.anchors.clear();
  EXPECT_EQ(compared(), ": the true positions of 3 landmarks.");
  record.ground_truth_m->bottomRows(1).setConstant(kNaN);
  record.anchors = {0, 1};
  EXPECT_EQ(compared(), ": the given positions of 2 anchors; no ground truth was given.");
  record.ground_truth_m.reset();
  record.anchors.clear();
  record.frame = Frame::kSimilarity;
  EXPECT_EQ(compared(), ": nothing; no ground truth was given.");
}

TEST(MapReport, HeadsPositionsOfAnchorsAloneAsGiven) {
  MapRecord record = triangle();
  EXPECT_EQ(landmarks(report_of(record)).columns[3].group, "Ground truth");
  record.ground_truth_m->bottomRows(1).setConstant(kNaN);
  record.anchors = {0, 1};
  const Report report = report_of(record);
  for (const Table* table : tables(report)) EXPECT_EQ(table->columns[3].group, "Given");
}

TEST(MapReport, ListsTheLargestErrorsOfManyLandmarks) {
  MapRecord record = triangle();
  const Eigen::Index M = 6000;
  record.names.clear();
  for (Eigen::Index i = 0; i < M; ++i) record.names.push_back("n" + std::to_string(i));
  record.ground_truth_m = Points::Zero(M, 2);
  record.estimate = Points::Zero(M, 2);
  record.estimate.col(0).setLinSpaced(0.0, 1.0);
  record.estimate.row(17).setConstant(kNaN);
  const Report report = report_of(record);
  check(report);
  const Table& table = landmarks(report);
  ASSERT_EQ(table.rows.size(), 1000u);
  EXPECT_EQ(std::get<TextCell>(table.rows[0].cells[0]).text, "n17");  // Not mapped: first.
  EXPECT_EQ(std::get<TextCell>(table.rows[1].cells[0]).text, "n5999");
  EXPECT_NE(table.caption.find("1000 largest errors of 6000 landmarks"), std::string::npos);
}

TEST(MapReport, ListsKnownErrorsOfManyLandmarksFirst) {
  MapRecord record = triangle();
  const Eigen::Index M = 6000;
  record.names.clear();
  for (Eigen::Index i = 0; i < M; ++i) record.names.push_back("n" + std::to_string(i));
  record.ground_truth_m = Points::Constant(M, 2, kNaN);
  record.estimate = Points::Zero(M, 2);
  for (const Eigen::Index anchor : {0, 1, 2, 5000}) {
    record.ground_truth_m->row(anchor) << 0.0, 0.0;
    record.estimate(anchor, 0) = static_cast<double>(anchor);
  }
  const Report report = report_of(record);
  const Table& table = landmarks(report);
  EXPECT_EQ(std::get<TextCell>(table.rows[0].cells[0]).text, "n5000");
  EXPECT_EQ(std::get<TextCell>(table.rows[3].cells[0]).text, "n0");
  EXPECT_EQ(std::get<TextCell>(table.rows[4].cells[0]).text, "n3");  // Of no known error.
  EXPECT_NE(table.caption.find("1000 of 6000 landmarks, those of known errors first"),
            std::string::npos);
}

TEST(MapReport, GivesCoordinatesFarFromZeroInFull) {
  MapRecord record = triangle();
  record.estimate.rowwise() += Eigen::RowVector2d(391234.5, 5821234.5);
  record.ground_truth_m->rowwise() += Eigen::RowVector2d(391234.5, 5821234.5);
  const Report report = report_of(record);
  const Table& table = landmarks(report);
  EXPECT_EQ(format_cell(table.rows[1].cells[1]), "391237.500");
  EXPECT_EQ(format_cell(table.rows[1].cells[2]), "5821238.500");
  EXPECT_EQ(format_cell(table.rows[1].cells[4]), "5821234.500");
  EXPECT_EQ(format_cell(table.rows[1].cells[5]), "5.000");
}

TEST(MapReport, SaysOverWhichLandmarksTheErrorIs) {
  MapRecord record;
  record.estimate = Points::Constant(6, 2, 1.0);
  record.ground_truth_m = record.estimate;
  record.estimate.row(5).setConstant(kNaN);
  record.anchors = {0, 1, 2};
  EXPECT_EQ(scored_landmarks_text(record), "");
  record.score = Score{0.219, 4.7, 0.2, 4.7};
  EXPECT_EQ(scored_landmarks_text(record), "2 landmarks, without the 3 anchors");
  record.score->mpe_m = kNaN;
  EXPECT_EQ(scored_landmarks_text(record), "5 landmarks");
}

TEST(MapReport, GivesASmallMapMoreDecimals) {
  MapRecord record = triangle();
  record.estimate *= 1e-3;
  EXPECT_EQ(format_cell(landmarks(report_of(record)).rows[1].cells[2]), "0.004000");
}

TEST(MapReport, HasNoErrorsWithoutGroundTruthAndNoMetresWithoutAnchors) {
  MapRecord record = triangle();
  record.ground_truth_m.reset();
  record.anchors.clear();
  record.frame = Frame::kSimilarity;
  const Report report = report_of(record);
  const Table& table = landmarks(report);
  EXPECT_EQ(table.columns.size(), 4u);
  EXPECT_EQ(table.columns[1].unit, "");
  EXPECT_NE(table.notes[0].find("defined up to"), std::string::npos);
}

TEST(MapReport, SaysOnlyErrorsThatAreKnown) {
  MapRecord record = triangle();
  record.score = Score{kNaN, kNaN, 0.31, 4.2};
  const Report report = report_of(record);
  const auto& items = report.opening.numbers.items;
  EXPECT_EQ(items[0].value, "0.310 m");
  EXPECT_EQ(
      items[0].detail,
      "map of 3.0 m by 4.0 m; mean position error over 2 landmarks, after the best affine fit "
      "to all landmarks");
  EXPECT_EQ(items[1].value, "4.20\u00A0%");
  record.score = Score{kNaN, kNaN, kNaN, kNaN};
  const Report unknown = report_of(record);
  for (const auto& item : unknown.opening.numbers.items) {
    EXPECT_EQ(item.value.find("nan"), std::string::npos) << item.label;
    EXPECT_EQ(item.value.find("unknown"), std::string::npos) << item.label;
    EXPECT_NE(item.label, "MPE");
  }
}

TEST(MapReport, TellsAnchorsThatDidNotTieTheMapFromNone) {
  MapRecord record = triangle();
  record.frame = Frame::kSimilarity;
  record.statuses.push_back(
      status_with_message(StatusCode::kAnchorsMissing, "1 of 1 anchors are on the map."));
  const auto findings = [](const Report& report) {
    std::string text;
    for (const Paragraph& item : std::get<BulletList>(report.sections[0].blocks[0]).items)
      for (const Phrase& phrase : item.phrases) text += phrase.text;
    return text;
  };
  const std::string given = findings(report_of(record));
  EXPECT_NE(given.find("could not be aligned to the anchors"), std::string::npos) << given;
  EXPECT_EQ(given.find("No anchors"), std::string::npos) << given;
  EXPECT_NE(given.find("2 things need attention, listed below."), std::string::npos) << given;
  record.anchors.clear();
  EXPECT_NE(findings(report_of(record)).find("No anchors were given"), std::string::npos);
}

TEST(MapReport, ListsWhatWasDroppedAndWhatWentWrong) {
  const Report report = report_of(triangle());
  const auto& input = report.sections[3];
  EXPECT_EQ(std::get<BulletList>(input.blocks.back()).items[0].phrases[0].text,
            "line 7: row dropped");
  const auto& list = std::get<StatusList>(report.sections[4].blocks[0]);
  EXPECT_EQ(list.items[0].code, "landmark_unseen");
  EXPECT_EQ(list.items[0].locations[0].detail, "1 landmark: c.");
}

TEST(MapReport, RefusesARecordWhosePartsDisagree) {
  MapRecord record = triangle();
  record.names.pop_back();
  EXPECT_THROW(report_of(record), InvalidInput);
  record = triangle();
  record.anchors = {3};
  EXPECT_THROW(report_of(record), InvalidInput);
}

}  // namespace
}  // namespace mapproof
