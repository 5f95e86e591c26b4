#include "reports/html/report_html.hpp"

#include <regex>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/sha256.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/study_report.hpp"
#include "tests/reports/hostile_report.hpp"
#include "tests/reports/synthetic_study.hpp"

namespace mapproof {
namespace {

std::string study_page() {
  const Study study = test::synthetic_study(3, 1);
  const StudyFigures figures = test::synthetic_figures(study);
  const auto timings = test::synthetic_timings(study);
  const auto sessions = test::synthetic_sessions();
  return report_html(
      study_report({study, sessions, timings, figures, "mapproof run x"}), load_templates(),
      [](const std::string& id) { return "<svg id=\"" + id + "\" viewBox=\"0 0 4 3\"></svg>"; });
}

/// The first group of every match.
std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin) + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

TEST(HtmlEscaped, LeavesNoCharacterThatHtmlReadsAsItsOwn) {
  EXPECT_EQ(html_escaped("<a href=\"x\">'&'</a>"),
            "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
}

TEST(ReportHtml, NamesItsOwnStyleSheetAndScriptInItsPolicy) {
  const std::string page = study_page();
  const std::string policy = between(page, "Security-Policy\" content=\"", "\">");
  EXPECT_NE(policy.find("default-src &#39;none&#39;"), std::string::npos) << policy;
  // Base64 needs no escaping in HTML, so the hashes stand as they are.
  EXPECT_NE(policy.find(policy_hash(between(page, "<style>", "</style>"))), std::string::npos);
  EXPECT_NE(policy.find(policy_hash(between(page, "<script>", "</script>"))), std::string::npos);
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
}

TEST(ReportHtml, FetchesNothing) {
  const std::string page = study_page();
  for (const std::string& target : all_matches(page, "(?:src|href|srcset|action)=\"([^\"]*)\""))
    EXPECT_TRUE(
        std::regex_match(target, std::regex("#[a-z0-9-]+|data:,|(figures|tables)/[a-z0-9.-]+")))
        << target;
  for (const char* word : {"http:", "https:", "//cdn", "@import", "url(", "<iframe", "<object",
                           "<embed", "<base", "fetch(", "XMLHttpRequest"})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
}

TEST(ReportHtml, HasNoInlineStyleOrHandlerThatItsPolicyWouldBlock) {
  const std::string page = study_page();
  EXPECT_TRUE(all_matches(page, "<[a-z]+[^>]* (style)=").empty());
  EXPECT_TRUE(all_matches(page, "<[a-z]+[^>]* (on[a-z]+)=").empty());
}

TEST(ReportHtml, GivesEachIdOnce) {
  std::set<std::string> seen;
  for (const std::string& id : all_matches(study_page(), " id=\"([^\"]*)\""))
    EXPECT_TRUE(seen.insert(id).second) << id;
}

TEST(ReportHtml, IsTheSameBytesEachTime) { EXPECT_EQ(study_page(), study_page()); }

TEST(ReportHtml, LetsNoTextBecomeATag) {
  const auto hostile = test::hostile_report();
  const std::string page = report_html(hostile.report, load_templates(), hostile.svg);
  EXPECT_EQ(all_matches(page, "(<script)").size(), 1u);
  EXPECT_EQ(all_matches(page, "(<style)").size(), 1u);
  EXPECT_TRUE(all_matches(page, "(<img)").empty());
  for (const auto& texts : {hostile.texts, hostile.attributes})
    for (const std::string& text : texts)
      EXPECT_NE(page.find(html_escaped(text)), std::string::npos) << text;
}

TEST(ReportHtml, ShowsBytesThatAreNotTextInsteadOfPassingThemOn) {
  const Report report{std::string("a\0b\xff\x1b", 5), "", {}, ""};
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_NE(page.find("a\u2400b\uFFFD\u241B"), std::string::npos);
  EXPECT_EQ(page.find('\0'), std::string::npos);
}

TEST(ReportHtml, StandsAloneWithoutOtherFolders) {
  const auto hostile = test::hostile_report();
  const std::string page = report_html(hostile.report, load_templates(), {}, {"", ""});
  EXPECT_TRUE(all_matches(page, "href=\"([^#d][^\"]*)\"").empty());
}

Report with_figures(int count) {
  Section section{"s", "S", {}};
  for (int i = 0; i < count; ++i)
    section.blocks.emplace_back(FigureBlock{"f-" + std::to_string(i), "", "", "", {}});
  Report report{"t", "", {section}, ""};
  report.opening.figure_ids = {"f-4"};
  return report;
}

TEST(ReportHtml, RefusesADrawingThatCouldEndTheElementThatHoldsIt) {
  const auto svg = [](const std::string&) { return "<svg></NoScript ><b></svg>"; };
  EXPECT_THROW(report_html(with_figures(5), load_templates(), svg), InvalidInput);
}

TEST(ReportHtml, LinksTheNumbersOfItsOpeningToTheirSections) {
  Report report;
  report.sections = {{"errors", "Errors", {}}};
  report.opening.numbers.items = {{"of 4 inside", "3", "one outside", "errors"}};
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_NE(page.find("<a href=\"#section-errors\"\n      aria-label=\"3 of 4 inside\">3</a>"),
            std::string::npos);
  report.opening.numbers.items[0].section = "elsewhere";
  EXPECT_THROW(report_html(report, load_templates(), {}), InvalidInput);
}

TEST(ReportHtml, MarksANumberThatFallsShortInWordsToo) {
  Report report;
  report.opening.numbers.items = {{.label = "of 4 found", .value = "3", .detail = ""}};
  const std::string met = report_html(report, load_templates(), {});
  EXPECT_EQ(met.find("falls short"), std::string::npos);
  EXPECT_EQ(met.find("class=\"detail\""), std::string::npos);
  report.opening.numbers.items[0].falls_short = true;
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_NE(page.find("<div class=\"short\">"), std::string::npos);
  EXPECT_NE(page.find("(falls short)"), std::string::npos);
}

TEST(ReportHtml, FoldsFindingsThatWouldPushTheFigureOffTheFirstScreen) {
  Report report;
  for (const char* words : {"one", "two", "three", "four", "five"})
    report.opening.findings.push_back({{phrase(words)}});
  const std::string page = report_html(report, load_templates(), {});
  const std::size_t fold = page.find("<summary>1 more finding</summary>");
  ASSERT_NE(fold, std::string::npos);
  EXPECT_LT(page.find("four"), fold);
  EXPECT_GT(page.find("five"), fold);
  report.opening.findings.resize(4);
  EXPECT_EQ(report_html(report, load_templates(), {}).find("more finding"), std::string::npos);
}

TEST(ReportHtml, FoldsLongFindingsButNeverWhatIsWrong) {
  Report report;
  report.opening.findings = {{{phrase("done")}},
                             {{phrase("long " + std::string(600, 'x'))}},
                             {{phrase("short")}},
                             {{strong("Warnings"), phrase(": something is wrong")}}};
  const std::string page = report_html(report, load_templates(), {});
  const std::size_t fold = page.find("<summary>2 more findings</summary>");
  ASSERT_NE(fold, std::string::npos);
  EXPECT_LT(page.find("something is wrong"), fold);
  EXPECT_GT(page.find("long xxx"), fold);
}

/// A report of studies of some sections each, each with a table and figures.
Report large_report(int studies, int sections) {
  Report report;
  for (int i = 0; i < studies; ++i)
    for (int j = 0; j < sections; ++j) {
      const std::string id = fmt::format("s{}-{}", i, j);
      Table table{.id = id, .caption = "c", .columns = {{"Method", "", "", ""}}};
      for (int row = 0; row < 10; ++row) table.rows.push_back({{TextCell{"m"}}, ""});
      Gallery gallery;
      for (int k = 0; k < 4; ++k)
        gallery.figures.push_back({.id = fmt::format("{}-{}", id, k), .title = "f"});
      report.sections.push_back(
          {id, "Section " + id, {gallery, table}, fmt::format("study {}", i)});
    }
  return report;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST(ReportHtml, OfManyStudiesFoldsSectionsButTheFirstOfEachAndWhatGotWorse) {
  const std::string small = report_html(large_report(1, 2), load_templates(), {});
  EXPECT_EQ(small.find("class=\"fold\""), std::string::npos) << "a short page is open";
  Report report = large_report(10, 6);
  std::get<Table>(report.sections.back().blocks[1]).rows[0].regressed = "MPE +18 %";
  const std::string page = report_html(report, load_templates(), {});
  const std::size_t closed = count_of(page, " class=\"closed\"");
  EXPECT_GT(closed, 30U);
  for (const char* open : {"s0-0", "s9-0", "s9-5"}) {
    const std::size_t at = page.find(fmt::format("<section id=\"section-{}\"", open));
    ASSERT_NE(at, std::string::npos) << open;
    EXPECT_EQ(page.substr(at, page.find('>', at) - at).find("closed"), std::string::npos) << open;
  }
}

TEST(ReportHtml, RefusesAnOpeningWithAMissingFigure) {
  Report report = with_figures(2);
  EXPECT_THROW(report_html(report, load_templates(), {}), InvalidInput);
}

TEST(ReportHtml, SaysHowItStandsOnlyWhereThatIsKnown) {
  Report report{"t", "", {}, ""};
  EXPECT_EQ(report_html(report, load_templates(), {}).find("class=\"standing"), std::string::npos);
  report.opening.standing =
      Standing{true, "Nightly run 5: 1 thing got worse", {"LLE is 5 % less accurate."}};
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_NE(page.find("class=\"standing worse\""), std::string::npos);
  EXPECT_NE(page.find("LLE is 5 % less accurate."), std::string::npos);
}

TEST(ReportHtml, NamesTheCommandOfAFigureWithTheProvenanceAlone) {
  Report report = with_figures(5);
  report.sections.push_back({"slam-provenance", "P", {}});
  report.figure_command = "mapproof render 'a b' --figure";
  const std::string page = report_html(report, load_templates(), {});
  const std::size_t at = page.find("<code>mapproof render &#39;a b&#39; --figure ID</code>");
  EXPECT_GT(at, page.find("section-slam-provenance"));
  EXPECT_EQ(page.find("mapproof render", at + 10), std::string::npos);
}

TEST(ReportHtml, RefusesAReportWithAnInvalidId) {
  Report report;
  report.sections.push_back({"no id", "", {}});
  EXPECT_THROW(report_html(report, load_templates(), {}), InvalidInput);
}

TEST(Html, FilesAreLinkedByPathsThatStayBesideThePage) {
  EXPECT_EQ(file_link("nightly_runs/0001/a b/report.html"),
            "./nightly_runs/0001/a%20b/report.html");
  EXPECT_EQ(file_link("javascript:alert(1)"), "./javascript%3Aalert%281%29");
  EXPECT_EQ(file_link("//host/x"), ".///host/x");
  EXPECT_EQ(file_link("\"><b>"), "./%22%3E%3Cb%3E");
}

}  // namespace
}  // namespace mapproof
