#pragma once

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "core/base/files/output_folder.hpp"
#include "reports/html/html_options.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// The bytes of a figure's drawing by its id; 0 if it has none.
using DrawingSize = std::function<std::size_t(const std::string& figure_id)>;

/// How much of a report stands on its pages.
struct PageLimits {
  std::size_t drawing_bytes = 5'200'000;  ///< Of drawings on the first page.
  std::size_t table_bytes = 2'600'000;    ///< Of tables on the first page, see table_bytes().
  std::size_t further_bytes = 5'200'000;  ///< Of drawings and tables on each further page.
};

/// About what a table takes of a page: within a third of it, from a few rows to thousands.
std::size_t table_bytes(const Table& table);

/// The ids of the figures that the first page holds: those of the opening come first, then those
/// that sections that most readers want have open, also where the page folds them; then figures and
/// 3-D figures, in their order, and last others that are folded.
std::set<std::string> figures_of_first_page(const Report& report, const DrawingSize& bytes_of,
                                            std::size_t drawing_bytes);

/// A report on as many pages as it needs. The first one is its index: it has all sections, texts
/// and warnings, and at the end of a section a link to each of its figures and tables that a
/// further page holds. Tables that show what got worse come first, then those that are not
/// secondary, in their order. The further pages have the rest in the order of the report, under the
/// titles of its sections; a table that exceeds a page is continued on the next. O(n) in blocks,
/// figures and rows. What fits on one page is one report that equals `report`.
std::vector<Report> pages_of(const Report& report, const DrawingSize& bytes_of,
                             const PageLimits& limits = {});

/// The path of a page from the report's folder: "report.html" of the first, "pages/2.html".
std::string page_path(std::size_t number);

/// Writes pages 2 to `count` of a report into its folder, and removes those that an earlier one had
/// in addition.
/// @param html_of  Makes a page by its number: one is held at a time.
/// @throws IoError.
void write_further_pages(const OutputFolder& folder, std::size_t count,
                         const std::function<std::string(std::size_t)>& html_of);

/// The options of a page of `count`, with the links between the pages.
/// @param options  Of the first page.
HtmlOptions page_options(std::size_t number, std::size_t count, HtmlOptions options);

}  // namespace mapproof
