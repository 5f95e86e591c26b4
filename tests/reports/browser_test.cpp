#include <cmath>

#include <gtest/gtest.h>

#include "reports/html/report_html.hpp"
#include "reports/sections/study_report.hpp"
#include "tests/reports/browser.hpp"
#include "tests/reports/hostile_report.hpp"
#include "tests/reports/synthetic_study.hpp"

namespace mapproof {
namespace {

using Findings = std::map<std::string, std::string>;

class Browser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::chromium()) GTEST_SKIP() << "no Chromium on this machine: apt-get install chromium";
  }

  static Findings look_at(const Report& report, const std::vector<std::string>& texts = {},
                          const std::vector<std::string>& attributes = {},
                          const SvgLookup& svg = {}) {
    return test::browse(report_html(report, load_templates(), svg), texts, attributes);
  }

  static void expect_readable(Findings found) {
    EXPECT_EQ(found["done"], "true") << found["error"];
    EXPECT_GE(std::atof(found["light-contrast"].c_str()), 4.5);
    EXPECT_GE(std::atof(found["dark-contrast"].c_str()), 4.5);
    for (const std::string width : {"390", "768", "1400"}) {
      EXPECT_LE(std::atoi(found["overflow-" + width].c_str()), 0) << width;
      EXPECT_EQ(found["spilled-" + width], "0") << width;
    }
  }
};

/// Ten comes before nine as text; the missing value and the NaN come last.
Report numbers() {
  Table table{"numbers", "Numbers", {{"Name", "", "", ""}, {"Value", "m", "", ""}}, {}, {}};
  const auto add = [&](const char* name, Cell cell) {
    table.rows.push_back({{TextCell{name}, std::move(cell)}, "", false});
  };
  add("K = 10", NumberCell{10});
  add("K = 9", NumberCell{9});
  add("none", MissingCell{});
  add("K = 2", NumberCell{-1e-7});
  add("huge", NumberCell{1e9});
  add("nan", NumberCell{std::nan("")});
  add("interval", IntervalCell{1, 3});
  return {"Numbers", "", {{"s", "S", {table}}}, ""};
}

TEST_F(Browser, SortsNumbersByTheirValueAndMissingOnesLast) {
  Findings found = look_at(numbers());
  EXPECT_EQ(found["ascending"], "-1e-07,2,9,10,1000000000,,");
  EXPECT_EQ(found["descending"], "1000000000,10,9,2,-1e-07,,");
  EXPECT_EQ(found["words"], "huge,interval,K = 2,K = 9,K = 10,nan,none");
  EXPECT_EQ(found["aria"], "ascending");
  EXPECT_EQ(found["aria-again"], "descending");
  EXPECT_EQ(found["sorted-columns"], "1");
  EXPECT_EQ(found["focusable"], "true");
}

/// A table of `rows` named rows, and one status with its place.
Report long_report(int rows) {
  Report report = numbers();
  Table table{"long", "Long", {{"Name", "", "", ""}}, {}, {}};
  for (int i = 0; i < rows; ++i)
    table.rows.push_back({{TextCell{"row" + std::to_string(i)}}, "", false});
  report.sections[0].blocks.emplace_back(table);
  StatusList list;
  list.items.push_back(
      {"bridged", "Meaning.", "bearing", 1, 1, false, {{"record-7", "detail seven"}}});
  report.sections[0].blocks.emplace_back(list);
  return report;
}

TEST_F(Browser, FoldsALongTableOnTheScreenButNotOnPaper) {
  Findings found = look_at(long_report(31));
  EXPECT_EQ(found["folded"], "true");
  EXPECT_EQ(found["fold-says"], "31 rows");
  EXPECT_EQ(found["folded-on-paper"], "false");
  expect_readable(found);
}

TEST_F(Browser, PrintsEveryRowOfATableWithItsScriptAndWithout) {
  if (std::system("command -v pdftotext >/dev/null 2>&1") != 0)
    GTEST_SKIP() << "no pdftotext on this machine: apt-get install poppler-utils";
  std::string page = report_html(long_report(40), load_templates(), {});
  for (const bool with_script : {true, false}) {
    if (!with_script)
      page.erase(page.find("<script"), page.find("</script>") - page.find("<script"));
    const std::string text = test::printed_text(page);
    for (const char* row : {"row0", "row39"})
      EXPECT_NE(text.find(row), std::string::npos) << row << " script: " << with_script;
    // A closed list of locations is opened by the script.
    EXPECT_EQ(text.find("detail seven") != std::string::npos, with_script);
  }
}

TEST_F(Browser, ShowsHostileTextsAsTextAndRunsNoneOfThem) {
  const auto hostile = test::hostile_report();
  Findings found = look_at(hostile.report, hostile.texts, hostile.attributes, hostile.svg);
  EXPECT_EQ(found["texts"], std::to_string(hostile.texts.size()));
  EXPECT_EQ(found["missing-texts"], "0");
  EXPECT_EQ(found["missing-attributes"], "0");
  EXPECT_EQ(found["scripts"], "1");
  EXPECT_EQ(found["images"], "1");  // The drawing at the head.
  EXPECT_EQ(found["landmarks-named"], std::to_string(hostile.landmarks.size()));
  EXPECT_EQ(found["handlers"], "0");
  EXPECT_EQ(found["pwned"], "false");
  EXPECT_EQ(found["fetched"], "0");
  expect_readable(found);
}

TEST_F(Browser, FindsAStudysReportReadableInLightAndDarkAndOnAPhone) {
  const Study study = test::synthetic_study();
  const StudyFigures figures = test::synthetic_figures(study);
  const auto timings = test::synthetic_timings(study);
  const auto sessions = test::synthetic_sessions();
  Findings found = look_at(study_report({study, sessions, timings, figures, "mapproof run x"}));
  // The switch is made by the script and coloured by the style sheet: the policy let both in.
  EXPECT_EQ(found["theme-changes"], "true");
  EXPECT_EQ(found["repeated-ids"], "0");
  EXPECT_EQ(found["fetched"], "0");
  expect_readable(found);
}

}  // namespace
}  // namespace mapproof
