#pragma once

#include <set>
#include <string>

#include <kainjow/mustache.hpp>

#include "reports/html/report_html.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// What is known of the figures of a page beyond their blocks.
struct FigureContext {
  SvgLookup svg = {};
  std::set<std::string> linked = {};  ///< Have a drawing that the page only links to.
};

/// Which figures of the report `drawn` has no room for, by HtmlOptions::drawing_bytes.
std::set<std::string> linked_figures(const Report& report, const SvgLookup& svg,
                                     std::size_t drawing_bytes);

/// What the figure's template is told.
/// @throws InvalidInput if its drawing holds the end tag of the element that holds it.
kainjow::mustache::data figure_data(const FigureBlock& figure, const FigureContext& drawn,
                                    const HtmlOptions& options);

}  // namespace mapproof
