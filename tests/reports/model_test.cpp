#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "reports/model/format.hpp"
#include "reports/model/page_text.hpp"
#include "reports/model/report.hpp"

namespace mapproof {
namespace {

Report report_with(Table table) { return {"t", "", {{"s", "S", {std::move(table)}}}, ""}; }

FigureBlock figure(const std::string& id) { return {id, "", "", "", {}}; }

TEST(FormatNumber, RoundsAndSignsAsAReaderExpects) {
  EXPECT_EQ(format_number(0.21949, 3), "0.219");
  EXPECT_EQ(format_number(-1.5, 1), "\u22121.5");
  EXPECT_EQ(format_number(1.5, 1, true), "+1.5");
  EXPECT_EQ(format_number(12, 0), "12");
  EXPECT_EQ(format_number(30000, 0), "30,000");
}

TEST(FormatNumber, GivesZeroNoSign) {
  EXPECT_EQ(format_number(-0.0, 2), "0.00");
  EXPECT_EQ(format_number(-0.001, 2), "0.00");
  EXPECT_EQ(format_number(0.001, 2, true), "0.00");
}

std::string shown(const Cell& cell, const std::string& unit) {
  return page_cell(cell, {"Title", unit, "", ""});
}

TEST(PageCell, HasPowersOfTen) {
  EXPECT_EQ(shown(NumberCell{8.04e15, 1, true}, "%"), "+8.04\u00A0×\u00A010¹⁵");
  EXPECT_EQ(shown(NumberCell{-2e-9, 6}, ""), "\u22122.00\u00A0×\u00A010⁻⁹");
  EXPECT_EQ(shown(IntervalCell{0.5, 1e15, 1}, "%"), "0.5 to 1.00\u00A0×\u00A010¹⁵");
}

TEST(PartText, HasItsThousandsApartInBothNumbersOrInNone) {
  EXPECT_EQ(part_text(2310, 25'700, "map"), "2,310 of 25,700 maps");
  EXPECT_EQ(part_text(2310, 9658, "map"), "2310 of 9658 maps");
  EXPECT_EQ(part_text(12'310, 25'700, "map"), "12,310 of 25,700 maps");
  EXPECT_EQ(part_text(1, 1, "run"), "1 of 1 run");
}

TEST(PValue, HasThreeDecimalsInProseAndInTables) {
  EXPECT_EQ(p_words(0.0341), "p = 0.034");
  EXPECT_EQ(p_words(0.5), "p = 0.500");
  EXPECT_EQ(p_words(1.0), "p = 1");
  EXPECT_EQ(p_words(4e-7), "p < 0.001");
  EXPECT_EQ(shown(p_cell(0.0341), ""), "0.034");
  EXPECT_EQ(shown(p_cell(4e-7), ""), "< 0.001");
  EXPECT_EQ(format_cell(p_cell(4e-7)), "< 0.001");
  EXPECT_EQ(p_cell(4e-7).value, 4e-7);  // Files and the order of rows have it.
}

TEST(PValue, OfAStrictTestHasAPowerOfTen) {
  EXPECT_EQ(small_p_words(0.0341), "p = 0.034");
  EXPECT_EQ(small_p_words(3.21e-7), "p = 3.2\u00A0×\u00A010⁻⁷");
  EXPECT_EQ(small_p_words(0.0), "p < 10⁻⁹");
}

TEST(PageCell, HasWordsForMapsThatDiverged) {
  EXPECT_EQ(shown(NumberCell{2.79e14, 4}, "m"), "over 1\u00A0km");
  EXPECT_EQ(shown(NumberCell{1900.25, 2}, "m"), "over 1\u00A0km");
  EXPECT_EQ(shown(NumberCell{-1900.25, 2}, "m"), "below \u22121\u00A0km");
  EXPECT_EQ(shown(NumberCell{900.25, 2}, "m"), "900.25");
  EXPECT_EQ(shown(IntervalCell{0.5, 1e15, 1}, "m"), "0.5 to over 1\u00A0km");
  EXPECT_EQ(shown(IntervalCell{0.0, 1e15, 4}, "m"), "0 to over 1\u00A0km");
  EXPECT_EQ(shown(IntervalCell{1500, 1e15, 1}, "m"), "over 1\u00A0km");
  EXPECT_EQ(shown(IntervalCell{0.5, 1.5, 1}, "m"), "0.5 to 1.5");
}

TEST(PageCell, HasPositionsOfAnySizeAsNumbers) {
  const Column easting{"x", "m", "Map", "", false};
  EXPECT_EQ(page_cell(NumberCell{652310.25, 2}, easting), "652310.25");
  const Column level{"0.1", "", "noise [m]", "", true};
  EXPECT_EQ(page_cell(NumberCell{1900.25, 2}, level), "over 1\u00A0km");
}

TEST(PageCell, HasWordsForErrorsInAColumnOfSeveralQuantities) {
  NumberCell error{2.79e14, 4};
  EXPECT_EQ(shown(error, ""), "2.79\u00A0×\u00A010¹⁴");
  error.error_m = true;
  EXPECT_EQ(shown(error, ""), "over 1\u00A0km");
}

TEST(FormatNumber, TurnsHugeNumbersIntoPowersAndMissingOnesIntoADash) {
  EXPECT_EQ(format_number(1.234e11, 3), "1.23e+11");
  EXPECT_EQ(format_number(5821234.5678, 3), "5821234.568");
  EXPECT_EQ(format_number(-5821234.5678, 1), "\u22125821234.6");
  EXPECT_EQ(format_number(std::nan(""), 3), "\u2013");
  EXPECT_EQ(format_number(std::numeric_limits<double>::infinity(), 3), "\u2013");
}

TEST(FormatNumber, ShowsDigitsOfWhatIsSmallAsAWhole) {
  EXPECT_EQ(format_number(1.23e-16, 6), "1.23e-16");
  EXPECT_EQ(format_number(-1.23e-16, 6), "\u22121.23e-16");
  EXPECT_EQ(format_number(0.0, 6), "0.000000");
  EXPECT_EQ(format_number(0.000123, 6), "0.000123");
}

TEST(FormatCell, ShowsAnIntervalWithoutAnEndAsMissing) {
  EXPECT_EQ(format_cell(IntervalCell{0.1, 0.25, 2}), "0.10 to 0.25");
  EXPECT_EQ(format_cell(IntervalCell{-0.1, 0.25, 2}), "\u22120.10 to 0.25");
  EXPECT_EQ(format_cell(IntervalCell{0.1, std::nan(""), 2}), "\u2013");
  EXPECT_EQ(format_cell(MissingCell{}), "\u2013");
}

TEST(FormatDuration, PicksTheUnit) {
  EXPECT_EQ(format_duration(0.34), "340 ms");
  EXPECT_EQ(format_duration(0.0021), "2.10 ms");
  EXPECT_EQ(format_duration(12.34), "12.3 s");
  EXPECT_EQ(format_duration(59.96), "1 min 0 s");
  EXPECT_EQ(format_duration(250), "4 min 10 s");
  EXPECT_EQ(format_duration(7500), "2 h 5 min");
  EXPECT_EQ(format_duration(std::nan("")), "\u2013");
}

TEST(Displayable, LeavesUtf8AndShowsTheRest) {
  EXPECT_EQ(displayable("\u00fcber \U0001F600"), "\u00fcber \U0001F600");
  EXPECT_EQ(displayable(std::string("a\0b", 3)), "a\u2400b");
  EXPECT_EQ(displayable("\x1b[31m\x7f"), "\u241b[31m\u2421");
  EXPECT_EQ(displayable("a\u0085b\u009b31m\u00a0"), "a\uFFFDb\uFFFD31m\u00a0");
  EXPECT_EQ(displayable("\xff\xc0\x80"), "\uFFFD\uFFFD\uFFFD");
  EXPECT_EQ(displayable("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");  // half of a surrogate pair
  EXPECT_EQ(displayable("cut \xe2\x82"), "cut \uFFFD\uFFFD");
}

TEST(PageText, KeepsNumbersAndTheirUnitsOnOneLine) {
  EXPECT_EQ(page_text("dead reckoning 16 m; over 1.9 km, 12 % in 3 ms"),
            "dead reckoning 16\u00A0m; over 1.9\u00A0km, 12\u00A0% in 3\u00A0ms");
  EXPECT_EQ(page_text("2 maps of 5 methods in step 4 should stay"),
            "2 maps of 5 methods in step 4 should stay");
  EXPECT_EQ(page_text("ISOMAP, K = 7, and p = 0.001; a = b"),
            "ISOMAP, K\u00A0=\u00A07, and p\u00A0=\u00A00.001; a = b");
  EXPECT_EQ(page_text("MPE 0.086 m"), "MPE 0.086\u00A0m");
  EXPECT_EQ(page_text(""), "");
}

TEST(PageText, KeepsDimensionsAndDatesOnOneLine) {
  EXPECT_EQ(page_text("spectral, 4-D 0.41 m; made 2026-11-27."),
            "spectral, 4\u2011D 0.41\u00A0m; made 2026\u201111\u201127.");
  EXPECT_EQ(page_text("in 3-D, 210 µs, 12 MiB"), "in 3\u2011D, 210\u00A0µs, 12\u00A0MiB");
  for (const char* other : {"layout-1-pose-2", "out/2026-11-27", "1-2-3", "2026-11-270", "-D", "-",
                            "7-Day", "2026-1-27"})
    EXPECT_EQ(page_text(other), other);
}

TEST(PageText, KeepsADateWithItsTimeAndItsZoneOnOneLine) {
  EXPECT_EQ(page_text("run 5 (2026-11-29 16:51 UTC), 3 m"),
            "run 5 (2026\u201111\u201129\u00a016:51\u00a0UTC), 3\u00a0m");
  EXPECT_EQ(page_text("2026-11-29 16:51 +01:00 and then"),
            "2026\u201111\u201129\u00a016:51\u00a0+01:00 and then");
  EXPECT_EQ(page_text("of 2026-11-29 16 runs"), "of 2026\u201111\u201129 16 runs");
}

TEST(IsDate, IsADayAndItsTimeWithNothingElse) {
  for (const char* date : {"2026-11-29", "2026-11-29 16:51 UTC", "2026-11-29 16:51 \u221205:00",
                           "2026-11-29T16:51:12Z"})
    EXPECT_TRUE(is_date(date)) << date;
  for (const char* other : {"", "2026", "2026-11-29 ", "2026-11-29 ISOMAP", "run 2026-11-29"})
    EXPECT_FALSE(is_date(other)) << other;
}

TEST(ReportCheck, RefusesAnIdThatCouldLeaveTheFolder) {
  for (const char* id : {"../../x", "", "A", "a/b", "a b", "<script>"})
    EXPECT_THROW(check(report_with({id, "", {}, {}, {}})), InvalidInput) << id;
  EXPECT_NO_THROW(check(report_with({"accuracy-1", "", {}, {}, {}})));
}

TEST(ReportCheck, RefusesIdsThatStandTwiceAndRowsThatLackCells) {
  Report twice = report_with({"a", "", {}, {}, {}});
  twice.sections[0].blocks.push_back(Table{"a", "", {}, {}, {}});
  EXPECT_THROW(check(twice), InvalidInput);
  EXPECT_THROW(check(report_with({"a", "", {{"x", "", "", ""}}, {{{}, "", false}}, {}})),
               InvalidInput);
}

TEST(TitleBelow, IsWhatATitleAddsToItsHeading) {
  EXPECT_EQ(title_below("Indoors", "Indoors, noise 0.1 m"), "noise 0.1 m");
  EXPECT_EQ(title_below("Bearing", "Bearing: MPE [m]"), "MPE [m]");
  for (const char* other : {"Bearings: MPE", "Bearing", "MPE"})
    EXPECT_EQ(title_below("Bearing", other), other);
}

TEST(ReportContents, AreListedInReadingOrderGalleriesIncluded) {
  Report report = report_with({"a", "", {}, {}, {}});
  report.sections[0].blocks.push_back(Gallery{{figure("f1"), figure("f2")}});
  report.sections[0].blocks.push_back(figure("f3"));
  ASSERT_EQ(figures(report).size(), 3u);
  EXPECT_EQ(figures(report)[2]->id, "f3");
  EXPECT_EQ(tables(report).size(), 1u);
}

}  // namespace
}  // namespace mapproof
