#pragma once

#include <set>
#include <string>

#include <kainjow/mustache.hpp>

#include "reports/html/html_options.hpp"
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

/// The text, or false where an empty one shall leave nothing behind.
inline kainjow::mustache::data text_or_false(const std::string& text) {
  return text.empty() ? kainjow::mustache::data(false) : kainjow::mustache::data(text);
}

/// What the table's template is told: heading rows, cells with the text to show and the key to sort
/// by, notes.
kainjow::mustache::data table_data(const Table& table, const HtmlOptions& options);

/// What the templates are told of a block. Every key that a template may ask for is set, since
/// Mustache would look for a missing one further out.
kainjow::mustache::data block_data(const Block& block, const FigureContext& drawn,
                                   const HtmlOptions& options);

/// The phrases of a paragraph, for the template of that name.
kainjow::mustache::data phrases_data(const Paragraph& paragraph, const HtmlOptions& options);

}  // namespace mapproof
