#include "reports/html/regression_marks.hpp"
#include "reports/html/report_html.hpp"

#include <regex>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/output/write_figure.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/sha256.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/sections/wording.hpp"
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

TEST(ReportHtml, ShowsNoTwoSmallFiguresOfOneKindAndNamesEachInAnotherWay) {
  const auto figure = [](const std::string& id, const std::string& title) {
    return FigureBlock{id, title, "c", "a", {}};
  };
  Report report{"r", "", {}, ""};
  report.sections = {
      {"one", "One", {Gallery{{figure("a-1", "First map"), figure("a-2", "Second map")}}}},
      {"two",
       "Two",
       {figure("b", "Relative errors over distance, in percent: SLAM is the lowest"),
        figure("c", "Relative errors over distance, in percent: SLAM drifts least"),
        figure("d", "A path")}}};
  report.opening.figure_ids = {"a-1", "a-2", "b", "c", "d"};
  report.opening.other_pages = "1 figure is on page 2.";
  const std::string page = report_html(report, load_templates(), {});
  const std::string small = between(page, "<ul class=\"thumbnails\">", "</ul>");
  EXPECT_EQ(all_matches(small, "href=\"#figure-([^\"]*)\""),
            (std::vector<std::string>{"a-1", "b", "c", "d"}));
  EXPECT_EQ(all_matches(small, "<bdi>([^<]*)</bdi>"),
            (std::vector<std::string>{
                "First map", "Relative errors over distance, in percent",
                "Relative errors over distance, in percent: SLAM drifts least", "A path"}));
  report.opening.main_figure = "b";
  const std::string beside_main = report_html(report, load_templates(), {});
  EXPECT_EQ(
      all_matches(between(beside_main, "<ul class=\"thumbnails\">", "</ul>"), "<bdi>([^<]*)</bdi>"),
      (std::vector<std::string>{
          "First map", "Relative errors over distance, in percent: SLAM drifts least", "A path"}))
      << "nor as the large figure";
  // What is elsewhere is said after all that is here.
  EXPECT_GT(page.find("1 figure is on page 2."), page.find("id=\"section-two\""));
}

TEST(ReportHtml, ShowsASmallFigureOfEachKindBeforeASecondOneOfAny) {
  Report report{"r", "", {{"s", "S", {}}}, ""};
  for (const char* id : {"curve-1", "curve-2", "map-1", "scene-1", "curve-3", "map-2"}) {
    FigureBlock figure{id, id, "c", "a", {}};
    figure.is_map = figure.id.starts_with("map");
    if (figure.id.starts_with("scene")) figure.value = "scene";
    report.opening.figure_ids.push_back(figure.id);
    report.sections[0].blocks.emplace_back(std::move(figure));
  }
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_EQ(
      all_matches(between(page, "<ul class=\"thumbnails\">", "</ul>"), "href=\"#figure-([^\"]*)\""),
      (std::vector<std::string>{"scene-1", "map-1", "curve-1", "curve-2", "curve-3", "map-2"}));
}

/// A curve in a unit of which `scale` are one.
ErrorPanel panel_of(const std::vector<double>& values, double scale = 1.0) {
  ErrorPanel panel{"", {.label = "steps"}, {{.label = "ISOMAP", .key = "isomap"}}, {}};
  for (const double value : values) {
    panel.lines[0].x.push_back(100.0 * static_cast<double>(panel.lines[0].x.size() + 1));
    panel.lines[0].mean.push_back(scale * value);
  }
  return panel;
}

TEST(ReportHtml, ShowsNothingTwiceOnItsFirstScreen) {
  const auto figure = [](const char* id, std::vector<ErrorPanel> panels) {
    FigureBlock block = figure_block(error_lines_figure({.id = id, .panels = std::move(panels)}));
    block.title = std::string("Errors ") + id;
    return block;
  };
  const std::vector<double> few = {0.31, 0.2, 0.12}, many = {0.3, 0.1, 0.07}, other = {3, 2, 4};
  Report report{"r", "", {}, ""};
  report.sections = {
      {"s",
       "S",
       {figure("all", {panel_of(few), panel_of(many)}), figure("few", {panel_of(few)}),
        figure("many-mm", {panel_of(many, 1000.0)}), figure("other", {panel_of(other)}),
        figure("other-first", {panel_of(other), panel_of(few)})}}};
  report.opening.main_figure = "all";
  report.opening.figure_ids = {"all", "few", "many-mm", "other", "other-first"};
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_EQ(
      all_matches(between(page, "<ul class=\"thumbnails\">", "</ul>"), "href=\"#figure-([^\"]*)\""),
      std::vector<std::string>{"other"});
  report.opening.figure_ids = {"few"};
  EXPECT_EQ(report_html(report, load_templates(), {}).find("class=\"thumbnails\""),
            std::string::npos);
}

TEST(ReportHtml, GivesEachIdOnce) {
  std::set<std::string> seen;
  for (const std::string& id : all_matches(study_page(), " id=\"([^\"]*)\""))
    EXPECT_TRUE(seen.insert(id).second) << id;
}

// The scripts of a page share one scope, where a second function of a name replaces the first.
TEST(ReportHtml, DefinesEachFunctionOfItsScriptsOnce) {
  const std::vector<std::string> names = all_matches(study_page(), "\nfunction ([A-Za-z]+)\\(");
  std::set<std::string> once;
  for (const std::string& name : names) EXPECT_TRUE(once.insert(name).second) << name;
  EXPECT_GT(once.size(), 100U);
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

TEST(ReportHtml, LinksANumberToTheTableThatHasIt) {
  Report report;
  report.sections = {{"errors", "Errors", {Table{"means", "Means", {}, {}, {}}}}};
  report.opening.numbers.items = {
      {.label = "best", .value = "7", .detail = "", .section = "errors", .table = "means"}};
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_NE(page.find("<a href=\"#table-means\"\n      aria-label=\"7 best\">7</a>"),
            std::string::npos);
  EXPECT_NE(page.find("id=\"table-means\""), std::string::npos);
  report.opening.numbers.items[0].table = "elsewhere";
  EXPECT_THROW(report_html(report, load_templates(), {}), InvalidInput);
}

TEST(ReportHtml, SaysANoteOfSeveralTablesOnceAndLinksLaterOnesToItAlone) {
  const auto table = [](const char* id, std::vector<std::string> notes) {
    return Table{id, id, {{"Method", "", "", ""}}, {}, std::move(notes)};
  };
  const Report report{"r",
                      "",
                      {{"s",
                        "S",
                        {table("one", {"Of one alone.", "Shared by all.", "Shared by two."}),
                         table("two", {"Shared by all.", "Of two alone."}),
                         table("three", {"Shared by all.", "Shared by two."})}}},
                      ""};
  const std::string page = report_html(report, load_templates(), {});
  const auto notes_of = [&](const std::string& id) {
    const std::string shown = page.substr(page.find("id=\"table-" + id));
    return all_matches(between(shown, "<ul class=\"notes\">", "</ul>"), "  <li(.*)</li>");
  };
  const std::string first = "<a href=\"#note-1\">note 1</a>";
  EXPECT_EQ(notes_of("one"),
            (std::vector<std::string>{">Of one alone.", " id=\"note-1\">Note 1: Shared by all.",
                                      " id=\"note-2\">Note 2: Shared by two."}));
  EXPECT_EQ(notes_of("two"), (std::vector<std::string>{">Of two alone.", ">See " + first + "."}));
  EXPECT_EQ(notes_of("three"),
            std::vector<std::string>{">See " + first + ", <a href=\"#note-2\">note 2</a>."});
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

TEST(ReportHtml, FoldsLongFindingsButNeverWhatIsWrongOrComparedWith) {
  Report report;
  report.opening.findings = {
      {{phrase("done")}}, {{phrase("long " + std::string(600, 'x'))}}, {{phrase("short")}}};
  report.opening.wrong = {{phrase(": something is wrong")}};
  report.opening.compared_with = {{phrase(": ground truth")}};
  const std::string page = report_html(report, load_templates(), {});
  const std::size_t fold = page.find("<summary>2 more findings</summary>");
  ASSERT_NE(fold, std::string::npos);
  EXPECT_LT(page.find("something is wrong"), fold);
  EXPECT_LT(page.find(": ground truth"), fold);
  EXPECT_LT(page.find("Warnings"), page.find("Compared with"));
  EXPECT_LT(page.find("done"), page.find("Warnings"));
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

std::string contents_of(const Report& report) {
  return between(report_html(report, load_templates(), {}), "<nav class=\"contents\"", "</nav>");
}

TEST(ReportHtml, ListsTheTablesAndFiguresOfASectionBelowItInItsContents) {
  const Table table{"errors", "Bearing: MPE [m], by observations", {{"Method", "", "", ""}}, {}};
  Gallery gallery{{{.id = "a", .title = "First map"},
                   {.id = "b", .title = "Second map"},
                   {.id = "c", .title = "Third map"}},
                  1};
  gallery.folded = "other maps";
  const Report report{"r",
                      "",
                      {{"bearing", "Bearing", {gallery, table}},
                       {"map", "Map", {FigureBlock{.id = "m", .title = "Map"}}},
                       {"provenance", "Provenance", {plain("By hand.")}}},
                      ""};
  const std::string contents = contents_of(report);
  EXPECT_EQ(all_matches(contents, "href=\"#([^\"]*)\""),
            (std::vector<std::string>{"section-bearing", "figure-a", "figure-b", "table-errors",
                                      "section-map", "section-provenance"}))
      << "neither a part named as its section nor a missing one makes a second level";
  EXPECT_EQ(all_matches(contents, "<bdi>([^<]*)</bdi>"),
            (std::vector<std::string>{"First map", "2 more figures: other maps",
                                      "MPE [m], by observations"}));
}

TEST(ReportHtml, HasTwoLevelsOfContentsForSeveralStudiesToo) {
  const std::string contents = contents_of(large_report(2, 1));
  EXPECT_EQ(count_of(contents, "<ol>"), 3U) << "the studies, and the sections of each";
  EXPECT_EQ(all_matches(contents, "href=\"#([^\"]*)\""),
            (std::vector<std::string>{"section-s0-0", "section-s1-0"}));
}

TEST(ReportHtml, SaysInOneLineWhatAFoldOfFiguresHolds) {
  const auto fold_of = [](Gallery gallery) {
    Report report = large_report(1, 1);
    report.sections[0].blocks = {std::move(gallery)};
    const std::string page = report_html(report, load_templates(), {});
    const std::size_t from = page.find("<summary><bdi>") + 14;
    return page.substr(from, page.find("</bdi>", from) - from);
  };
  Gallery gallery{{{.id = "a-1", .title = "First map"}, {.id = "a-2", .title = "Second map"}}, 1};
  EXPECT_EQ(fold_of(gallery), "1 more figure: Second map");
  gallery.open = 0;
  gallery.figures[0].title = std::string(70, 'm');
  EXPECT_EQ(fold_of(gallery), "2 figures");
  gallery.folded = "errors over the floor";
  EXPECT_EQ(fold_of(gallery), "2 figures: errors over the floor");
}

TEST(ReportHtml, KeepsQuantitiesOnOneLine) {
  Report report = large_report(1, 1);
  report.sections[0].blocks = {
      Paragraph{{{"By 4-D it is 0.12 m; ", Emphasis::kPlain}, {"a 12 m", Emphasis::kCode}}}};
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_NE(page.find("By 4\u2011D it is 0.12\u00A0m; "), std::string::npos);
  EXPECT_NE(page.find("a 12 m"), std::string::npos) << "a command stays as it is typed";
}

TEST(ReportHtml, KeepsQuantitiesOfHeadingsOnOneLineInItsContentsToo) {
  const Table table{"late", "Stamped 5 s late", {{"Method", "", "", ""}}, {}};
  const Report report{"r", "", {{"late", "Ranges stamped 5 s late", {table}}}, ""};
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_NE(page.find(">Stamped 5\u00A0s late<"), std::string::npos);
  EXPECT_NE(contents_of(report).find(">Ranges stamped 5\u00A0s late<"), std::string::npos);
}

TEST(ReportHtml, KeepsDatesOnOneLine) {
  const Table table{"t",
                    "c",
                    {{"Started", "", "", ""}, {"Note", "", "", ""}},
                    {{{TextCell{"2026-11-29 16:51 UTC"}, TextCell{"since 2026-11-29"}}, ""}},
                    {}};
  const Paragraph begun{{phrase("Begun 2026-11-29 16:51 UTC.")}};
  const Report report{"r", "", {{"s", "S", {table, begun}}}, ""};
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_EQ(all_matches(page, "class=\"date\">(?:<bdi[^>]*>)([^<]*)"),
            std::vector<std::string>{"2026-11-29 16:51 UTC"})
      << "as it is, so that it can be searched and copied";
  EXPECT_NE(page.find("<p>Begun 2026\u201111\u201129\u00a016:51\u00a0UTC."), std::string::npos);
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

TEST(ReportHtml, FoldsTablesOfWhatGotWorseLastOfAllAndCountsTheirRows) {
  Report report = large_report(1, 30);
  for (Section& section : report.sections)
    for (Block& block : section.blocks)
      if (auto* table = std::get_if<Table>(&block)) table->rows[0].regressed = "MPE +18 %";
  const std::size_t regressed = tables(report).size();
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_EQ(count_of(page, ">1 row got worse</span>"), regressed - 1);
  EXPECT_LT(page.find("MPE +18 %"), page.find("1 row got worse")) << "the first one is open";
}

TEST(ReportHtml, FoldsWhatFewReadersWantFirstAndWhatMostWantLast) {
  Report report = large_report(1, 9);
  report.sections[1].interest = Interest::kFew;
  report.sections[8].interest = Interest::kMost;
  BulletList list;
  for (int i = 0; i < 9; ++i) list.items.push_back(plain(fmt::format("point {}", i)));
  report.sections[0].blocks.emplace_back(list);
  const std::string page = report_html(report, load_templates(), {});
  const auto section = [&](const char* id) {
    const std::size_t at = page.find(fmt::format("<section id=\"section-{}\"", id));
    return page.substr(at, page.find("</section>", at) - at);
  };
  const std::string few = section("s0-1"), most = section("s0-8");
  EXPECT_NE(few.find("class=\"closed\""), std::string::npos);
  EXPECT_EQ(most.find("class=\"closed\""), std::string::npos);
  EXPECT_EQ(most.find("class=\"fold"), std::string::npos) << "its table and its figures are open";
  const std::string first = section("s0-0");
  const std::size_t more = first.find("<summary>6 more</summary>");
  ASSERT_NE(more, std::string::npos);
  EXPECT_LT(first.find("point 2"), more);
  EXPECT_GT(first.find("point 3"), more);
}

TEST(ReportHtml, SaysWarningsInWords) {
  Report report{"t", "", {{"w", "Warnings", {}}}, ""};
  StatusList list;
  list.items.push_back(
      {"not_converged", "It stopped early.", "bearing, LLE", 1, 4, false, {{"r", ""}}});
  report.sections[0].blocks.emplace_back(list);
  const std::string page = report_html(report, load_templates(), {});
  EXPECT_NE(page.find("<th scope=\"col\">not converged</th>"), std::string::npos);
  EXPECT_EQ(page.find("not_converged"), std::string::npos);
}

TEST(ReportHtml, RefusesAnOpeningWithAMissingFigure) {
  Report report = with_figures(2);
  EXPECT_THROW(report_html(report, load_templates(), {}), InvalidInput);
}

TEST(ReportHtml, SaysHowItStandsOnlyWhereThatIsKnown) {
  Report report{"t", "", {}, ""};
  EXPECT_EQ(report_html(report, load_templates(), {}).find("class=\"standing"), std::string::npos);
  report.opening.standing = Standing{
      .worse = true,
      .title = "Nightly run 5: 1 thing got worse",
      .sentences = {"LLE is 5 % less accurate."},
      .rest = {{{phrase("And 4 more, among "), {"a #b.html", Emphasis::kFile, "section-c"}}}},
      .note = "All of these got worse since nightly run 5."};
  HtmlOptions options;
  options.link_words["a #b.html#section-c"] = "all findings";
  const std::string page = report_html(report, load_templates(), {}, options);
  EXPECT_NE(page.find("class=\"standing worse\""), std::string::npos);
  EXPECT_NE(page.find("LLE is 5\u00a0% less accurate."), std::string::npos);
  EXPECT_NE(page.find("href=\"./a%20%23b.html#section-c\">all findings</a>"), std::string::npos);
  EXPECT_NE(page.find("<p><bdi>All of these got worse since nightly run 5.</bdi></p>"),
            std::string::npos);
}

TEST(ReportHtml, ShowsAShortWordForALinkInATableAndSaysTheWholeToScreenReaders) {
  Report report{"t", "", {}, ""};
  Table table{.id = "t",
              .caption = "c",
              .columns = {{"Run", "", "", ""}, {"Report", "", "", ""}},
              .rows = {},
              .notes = {}};
  table.rows = {{{TextCell{"6"}, TextCell{"a.html", Emphasis::kFile, "report"}}, ""},
                {{TextCell{"7"}, TextCell{"a.html", Emphasis::kFile}}, ""}};
  report.sections = {{"s", "S", {table}}};
  HtmlOptions options;
  options.link_words["a.html"] = "report of nightly run 6";
  const std::string page = report_html(report, load_templates(), {}, options);
  EXPECT_NE(page.find("href=\"./a.html\" aria-label=\"report of nightly run 6\">report</a>"),
            std::string::npos);
  EXPECT_NE(page.find("href=\"./a.html\">report of nightly run 6</a>"), std::string::npos);
}

TEST(ReportHtml, DrawsAChangeInTheColourOfItsFindings) {
  Report report{"t", "", {}, ""};
  Table table{.id = "t", .caption = "c", .columns = {{"Study", "", "", ""}, {"Worse", "", "", ""}}};
  Row row{{TextCell{"mine"}, TextCell{"seconds"}}, ""};
  row.curves = {{.cell = 1, .changes = {-2.0, 0.5, 40.0}, .is_found = {false, false, false}}};
  table.rows = {row};
  report.sections = {{"s", "S", {table}}};
  const auto page_with = [&](bool is_found) {
    std::get<Table>(report.sections[0].blocks[0]).rows[0].curves[0].is_found[2] = is_found;
    return report_html(report, load_templates(), {});
  };
  EXPECT_NE(page_with(true).find("<circle class=\"worse\""), std::string::npos);
  EXPECT_NE(page_with(false).find("<circle class=\"same\""), std::string::npos);
  std::get<Table>(report.sections[0].blocks[0]).rows[0].curves[0].changes[2] = -3.0;
  EXPECT_NE(page_with(false).find("<circle class=\"better\""), std::string::npos);
}

TEST(RegressionMarks, AreRingsAroundThePointsOfTheCurve) {
  const std::string svg =
      "<svg><path data-curve=\"A &amp; B\" d=\"m0 0\"/>"
      "<g id=\"f-mean\" data-curve=\"A &amp; B\" data-points=\"6, 0.1;8, 0.2\">"
      "<path class=\"line\" clip-path=\"url(#f-c0)\" d=\"m0 0\"/>"
      "<use class=\"marker\" href=\"#f-s1\" x=\"10\" y=\"20\"/>"
      "<use class=\"marker\" href=\"#f-s1\" x=\"30\" y=\"40\"/></g></svg>";
  const auto rings = [&](const RegressedCurve& curve) {
    std::string marked = svg;
    mark_curve(curve, marked);
    std::string centres;
    for (const std::string& at :
         all_matches(marked, "class=\"got-worse\" href=\"#f-ring\" ([^/]*)/"))
      centres += at + ";";
    // One ring is drawn, and used at each point.
    EXPECT_EQ(all_matches(marked, "(<circle id=\"f-ring\")").size(), centres.empty() ? 0U : 1U);
    return centres;
  };
  EXPECT_EQ(rings({"A & B", {}}), "x=\"10\" y=\"20\";x=\"30\" y=\"40\";");
  EXPECT_EQ(rings({"A & B", {8.0}}), "x=\"30\" y=\"40\";");
  EXPECT_EQ(rings({"A", {}}), "");
}

/// The drawing of a line in each of two panels.
std::string two_panels(const ErrorLine& line) {
  ErrorLinesSpec spec{.id = "f", .title = "MPE over K", .panels = {{.title = "a"}, {.title = "b"}}};
  for (ErrorPanel& panel : spec.panels) panel.lines = {line};
  return figure_svg(error_lines_figure(spec), report_theme());
}

std::vector<double> centres(const std::string& svg) {
  std::vector<double> all;
  for (const std::string& x :
       all_matches(svg, "class=\"got-worse\" href=\"#[^\"]*\" x=\"([0-9.]+)\""))
    all.push_back(std::stod(x));
  return all;
}

TEST(RegressionMarks, AreOnTheCurveOfOnePanelWhateverItsNameAndErrors) {
  const std::string label = "A & B's \"map\"";
  const std::string svg =
      two_panels({.label = label, .key = "a", .x = {6.0, 8.0, 10.0}, .mean = {0.1, 0.2, 2000.0}});
  ASSERT_NE(svg.find("data-over"), std::string::npos) << "an error is above 1 km";
  std::string left = svg, right = svg, one = svg, none = svg;
  EXPECT_EQ(mark_curve({.label = label, .panel = 0}, left), 3U);
  EXPECT_EQ(mark_curve({.label = label, .panel = 1}, right), 3U);
  EXPECT_EQ(mark_curve({.label = label, .at = {8.0}, .panel = 1}, one), 1U);
  EXPECT_EQ(mark_curve({.label = label, .at = {7.0}, .panel = 1}, none), 0U);
  ASSERT_EQ(centres(left).size(), 3U);
  ASSERT_EQ(centres(right).size(), 3U);
  EXPECT_LT(centres(left).back(), centres(right).front());
  EXPECT_EQ(centres(one), std::vector<double>{centres(right)[1]});
  EXPECT_EQ(none, svg);
}

TEST(RegressionMarks, AreNotDrawnWhereAPointHasNoMarker) {
  ErrorLine line{.label = "A", .key = "a"};
  for (int i = 0; i < 500; ++i) {
    line.x.push_back(i);
    line.mean.push_back(1.0 + 0.001 * i);
  }
  std::string svg = two_panels(line);
  EXPECT_EQ(mark_curve({.label = "A", .at = {0.0}}, svg), 1U);
  EXPECT_EQ(mark_curve({.label = "A", .at = {1.0}}, svg), 0U) << "too near to the marker before";
}

TEST(ReportHtml, SaysThatAPointIsRingedWhereItIs) {
  const ErrorLine line{.label = "A", .key = "a", .x = {6.0, 8.0}, .mean = {0.1, 0.2}};
  Report report = with_figures(5);
  report.opening.main_figure = "f-0";
  auto& figure = std::get<FigureBlock>(report.sections[0].blocks[0]);
  figure.regressed = "A: MPE +20 %";
  const auto said = [&](const std::string& svg) {
    const std::string page =
        report_html(report, load_templates(), [&](const std::string&) { return svg; });
    EXPECT_EQ(all_matches(page, "(A: MPE \\+20 %)").size(), 2U) << "with the figure, and first";
    return all_matches(page, "(ringed in the figure)").size();
  };
  figure.regressed_curves = {{.label = "A", .at = {8.0}}};
  EXPECT_EQ(said(two_panels(line)), 2U);
  EXPECT_EQ(said("<svg></svg>"), 0U);
  figure.regressed_curves = {{.label = "A", .at = {7.0}}};
  EXPECT_EQ(said(two_panels(line)), 0U);
  figure.regressed_curves = {{.label = "A", .at = {8.0}}, {.label = "B"}};
  EXPECT_EQ(said(two_panels(line)), 0U) << "one of two curves is not ringed";
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
