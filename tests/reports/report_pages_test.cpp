#include "reports/html/report_pages.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "core/base/files/temporary_folder.hpp"
#include "reports/html/report_html.hpp"
#include "reports/model/report.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kDrawing = 1000;  ///< Bytes of each drawing here.

std::size_t size_of_drawing(const std::string&) { return kDrawing; }

std::string drawing_of(const std::string& id) {
  std::string text = "<svg><title>" + id + "</title>";
  text.resize(kDrawing - 6, ' ');
  return text + "</svg>";
}

Table table_of(const std::string& id, int rows, int columns) {
  Table table{.id = id, .caption = "Errors of " + id + ".", .columns = {{"Method", "", "", ""}}};
  for (int column = 1; column < columns; ++column)
    table.columns.push_back({fmt::format("at {}", column), "m", "", ""});
  for (int i = 0; i < rows; ++i) {
    Row row{{TextCell{fmt::format("method {}", i)}}, ""};
    for (int column = 1; column < columns; ++column)
      row.cells.emplace_back(NumberCell{0.123456789 * (i + column), 3});
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Sections with a gallery of figures and a table each.
Report report_of(int sections, int figures) {
  Report report{.title = "T", .subtitle = "S", .sections = {}, .footer = "F"};
  for (int i = 0; i < sections; ++i) {
    Gallery gallery;
    for (int k = 0; k < figures; ++k)
      gallery.figures.push_back(
          {fmt::format("f-{}-{}", i, k), fmt::format("Figure {} of site {}", k, i), "", "", {}});
    report.sections.push_back(
        {fmt::format("s-{}", i),
         fmt::format("Site {}", i),
         {Paragraph{{phrase("Words.")}}, gallery, table_of(fmt::format("t-{}", i), 2, 3)}});
  }
  return report;
}

std::vector<const PageLinks::Item*> links_of(const Report& report) {
  std::vector<const PageLinks::Item*> links;
  for (const Section& section : report.sections)
    for (const Block& block : section.blocks)
      if (const auto* some = std::get_if<PageLinks>(&block))
        for (const PageLinks::Item& item : some->items) links.push_back(&item);
  return links;
}

std::vector<std::string> html_of(const std::vector<Report>& pages) {
  std::vector<std::string> html;
  for (std::size_t number = 1; number <= pages.size(); ++number)
    html.push_back(report_html(pages[number - 1], load_templates(), drawing_of,
                               page_options(number, pages.size(), {})));
  return html;
}

TEST(ReportPages, WhatFitsIsOnePageThatLinksNothing) {
  const Report report = report_of(3, 2);
  const std::vector<Report> pages = pages_of(report, size_of_drawing);
  ASSERT_EQ(pages.size(), 1U);
  EXPECT_TRUE(links_of(pages[0]).empty());
  EXPECT_EQ(pages[0].opening.other_pages, "");
  EXPECT_EQ(report_html(pages[0], load_templates(), drawing_of),
            report_html(report, load_templates(), drawing_of));
}

TEST(ReportPages, TheFirstHoldsTheFiguresOfTheOpeningThenFiguresThenScenes) {
  Report report{.title = "t", .subtitle = "", .sections = {{"s", "S", {}}}, .footer = ""};
  for (int i = 0; i < 6; ++i)
    report.sections[0].blocks.emplace_back(
        FigureBlock{fmt::format("f-{}", i), "", "", "", {}, i % 2 == 0 ? "scene" : "figure"});
  report.opening.figure_ids = {"f-4"};
  EXPECT_EQ(figures_of_first_page(report, size_of_drawing, 3 * kDrawing + 500),
            (std::set<std::string>{"f-1", "f-3", "f-4"}));
  // A drawing that is larger than a page leaves the opening, too.
  const std::vector<Report> pages = pages_of(report, size_of_drawing, {.drawing_bytes = 500});
  EXPECT_TRUE(pages[0].opening.figure_ids.empty());
}

TEST(ReportPages, TheFirstHoldsWhatSectionsOfMostInterestHaveOpenAlsoWhereAHighPageFoldsIt) {
  constexpr int kSections = 40;
  Report report = report_of(kSections, 3);
  std::set<std::string> open;
  for (int i = kSections / 2; i < kSections; ++i) {
    Section& section = report.sections[static_cast<std::size_t>(i)];
    section.interest = Interest::kMost;
    std::get<Gallery>(section.blocks[1]).open = 2;
    for (int k = 0; k < 2; ++k) open.insert(fmt::format("f-{}-{}", i, k));
  }
  EXPECT_EQ(figures_of_first_page(report, size_of_drawing, open.size() * kDrawing), open);
}

TEST(ReportPages, EachFigureAndTableStandsOnOnePageWhereItsLinkLeads) {
  const Report report = report_of(40, 5);
  const PageLimits limits{.drawing_bytes = 20'000, .table_bytes = 10'000, .further_bytes = 50'000};
  const std::vector<Report> pages = pages_of(report, size_of_drawing, limits);
  ASSERT_GT(pages.size(), 5U);
  std::map<std::string, std::string> page_of;
  for (std::size_t number = 1; number <= pages.size(); ++number) {
    for (const FigureBlock* figure : figures(pages[number - 1]))
      EXPECT_TRUE(page_of.emplace("figure-" + figure->id, page_path(number)).second) << figure->id;
    for (const Table* table : tables(pages[number - 1]))
      EXPECT_TRUE(page_of.emplace("table-" + table->id, page_path(number)).second) << table->id;
  }
  EXPECT_EQ(page_of.size(), 40U * 6U);
  std::size_t elsewhere = 0;
  for (const auto& [element, page] : page_of) elsewhere += page == page_path(1) ? 0 : 1;
  const auto links = links_of(pages[0]);
  EXPECT_EQ(links.size(), elsewhere);
  for (const PageLinks::Item* link : links) {
    EXPECT_EQ(page_of.at(link->element), link->page);
    EXPECT_NE(link->title, "");
  }
  EXPECT_EQ(pages[0].sections.size(), 40U);
  EXPECT_NE(pages[0].opening.other_pages.find("180 of 200 figures and"), std::string::npos)
      << pages[0].opening.other_pages;
}

TEST(ReportPages, AreNoLargerThanTheirLimitAndWhatEveryPageHas) {
  const PageLimits limits{.drawing_bytes = 20'000, .table_bytes = 10'000, .further_bytes = 50'000};
  const std::size_t frame = report_html({"T", "", {}, "F"}, load_templates(), {}).size();
  const auto html = html_of(pages_of(report_of(40, 5), size_of_drawing, limits));
  for (std::size_t i = 1; i < html.size(); ++i)
    EXPECT_LT(html[i].size(), frame + limits.further_bytes * 4 / 3) << i;
  // The first page grows by some hundred bytes for each of what it links.
  const auto more = html_of(pages_of(report_of(80, 5), size_of_drawing, limits));
  EXPECT_LT(more[0].size() - html[0].size(), 40U * (6U * 250U + 700U));
}

TEST(ReportPages, LeadToEachOtherAndToTheFilesBesideTheReport) {
  const PageLimits limits{.drawing_bytes = 0, .table_bytes = 0, .further_bytes = 20'000};
  const auto html = html_of(pages_of(report_of(12, 3), size_of_drawing, limits));
  ASSERT_GT(html.size(), 3U);
  EXPECT_NE(html[0].find("<li id=\"figure-f-0-0\"><a href=\"./pages/2.html#figure-f-0-0\">"),
            std::string::npos);
  EXPECT_NE(html[1].find("href=\"./../report.html\""), std::string::npos);
  EXPECT_NE(html[1].find("href=\"./../pages/3.html\""), std::string::npos);
  EXPECT_EQ(html[1].find("href=\"./../pages/2.html\""), std::string::npos);
  EXPECT_NE(html[2].find("href=\"./../pages/2.html\""), std::string::npos);
  EXPECT_NE(html[1].find("href=\"../figures/f-0-0.svg\""), std::string::npos);
  EXPECT_NE(html[1].find("href=\"../tables/t-0.csv\""), std::string::npos);
  EXPECT_EQ(html.back().find(fmt::format("pages/{}.html", html.size() + 1)), std::string::npos);
  EXPECT_EQ(html[1].find("class=\"closed\""), std::string::npos) << "a low page";
}

TEST(ReportPages, FoldAsTheFirstOneDoesWhereTheyAreHigh) {
  const PageLimits limits{.drawing_bytes = 0, .table_bytes = 0, .further_bytes = 10'000'000};
  const auto html = html_of(pages_of(report_of(40, 5), size_of_drawing, limits));
  ASSERT_EQ(html.size(), 2U);
  EXPECT_NE(html[1].find("class=\"closed\""), std::string::npos);
}

TEST(ReportPages, ATableThatExceedsAPageIsContinuedRowByRow) {
  Report report{.title = "T", .subtitle = "", .sections = {{"s", "S", {}}}, .footer = ""};
  report.sections[0].blocks.emplace_back(table_of("long", 500, 4));
  const PageLimits limits{.table_bytes = 20'000, .further_bytes = 50'000};
  const std::vector<Report> pages = pages_of(report, size_of_drawing, limits);
  ASSERT_GT(pages.size(), 4U);
  ASSERT_EQ(links_of(pages[0]).size(), 1U);
  EXPECT_EQ(links_of(pages[0])[0]->page, "pages/2.html");
  std::vector<std::string> methods;
  for (const Report& page : pages)
    for (const Table* table : tables(page))
      for (const Row& row : table->rows) methods.push_back(std::get<TextCell>(row.cells[0]).text);
  ASSERT_EQ(methods.size(), 500U);
  for (std::size_t i = 0; i < methods.size(); ++i)
    EXPECT_EQ(methods[i], fmt::format("method {}", i));
  EXPECT_NE(tables(pages[1])[0]->caption.find(" Rows 1 to "), std::string::npos);
}

TEST(ReportPages, ATableThatShowsWhatGotWorseStaysOnTheFirst) {
  Report report = report_of(20, 0);
  std::get<Table>(report.sections.back().blocks.back()).rows[0].regressed = "MPE +18 %";
  const auto pages = pages_of(report, size_of_drawing, {.table_bytes = 5000});
  const auto first = tables(pages[0]);
  EXPECT_NE(std::ranges::find(first, std::string("t-19"), &Table::id), first.end());
}

TEST(ReportPages, EstimateATableToAThirdOfItsBytes) {
  const std::size_t frame =
      report_html({"T", "", {{"s", "S", {}}}, ""}, load_templates(), {}).size();
  for (const auto& [rows, columns] : {std::pair{2, 9}, {20, 3}, {300, 6}, {3000, 9}}) {
    const Table table = table_of("t", rows, columns);
    const Report report{"T", "", {{"s", "S", {table}}}, ""};
    const auto actual =
        static_cast<double>(report_html(report, load_templates(), {}).size() - frame);
    const auto estimated = static_cast<double>(table_bytes(table));
    EXPECT_LT(estimated, 4.0 / 3.0 * actual) << rows << " x " << columns;
    EXPECT_GT(estimated, 2.0 / 3.0 * actual) << rows << " x " << columns;
  }
}

TEST(ReportPages, AskEachDrawingForItsSizeAFewTimesHoweverManyThereAre) {
  const Report report = report_of(200, 10);
  std::map<std::string, int> asked;
  const auto counting = [&](const std::string& id) {
    ++asked[id];
    return kDrawing;
  };
  const auto pages = pages_of(report, counting, {.drawing_bytes = 50'000, .further_bytes = 50'000});
  EXPECT_GT(pages.size(), 20U);
  for (const auto& [id, times] : asked) EXPECT_LE(times, 2) << id;
}

TEST(ReportPages, ThoseOfAnEarlierReportThatHadMoreAreRemovedAndNoOthers) {
  const TemporaryFolder folder("pages");
  const auto page = [](std::size_t number) {
    return report_html({fmt::format("page {}", number), "", {}, ""}, load_templates(), {});
  };
  write_further_pages(folder.path(), 5, page);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "pages/5.html"));
  write_file(folder.path() / "pages/notes.html", "mine");
  write_further_pages(folder.path(), 3, page);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "pages/3.html"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "pages/4.html"));
  write_file(folder.path() / "pages/2.html", "of somebody else");
  write_further_pages(folder.path(), 1, page);
  EXPECT_EQ(read_file(folder.path() / "pages/2.html"), "of somebody else");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "pages/notes.html"));
}

}  // namespace
}  // namespace mapproof
