#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

#include <kainjow/mustache.hpp>

#include "reports/html/html_options.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

inline constexpr std::size_t kMostRowsOpen = 30;  ///< Longer tables are folded at first.
/// Longer lists of links to other pages are folded at first.
inline constexpr std::size_t kMostLinksOpen = 12;

/// Where a page has a note of its tables.
struct FirstNote {
  const Table* table = nullptr;  ///< The first one that has it.
  std::size_t number = 0;  ///< Of the notes that several tables have, from 1; 0: no other has it.
};

/// Facts on the figures of a page besides their blocks.
struct FigureContext {
  SvgLookup svg = {};
  std::map<std::string, FirstNote> notes = {};  ///< Of its tables: later ones refer to the first.
};

/// Each note of the report's tables; those of several tables are numbered in the order of the page.
std::map<std::string, FirstNote> first_notes(const Report& report);

/// A drawing with rings around the points of curves that got worse.
struct MarkedDrawing {
  std::string svg = {};
  bool ringed = false;  ///< Each of the figure's regressed curves has a ring in some panel.
};
MarkedDrawing marked_drawing(const FigureBlock& figure, const FigureContext& drawn);

/// The line in place of the figures that a page folds: "26 more figures: errors over the floor and
/// …", with their titles alone where they are short.
std::string folded_words(const Gallery& gallery);

/// The data for the figure's template.
/// @throws InvalidInput if its drawing holds the end tag of the element that holds it.
kainjow::mustache::data figure_data(const FigureBlock& figure, const FigureContext& drawn,
                                    const HtmlOptions& options);

/// The text, or false if an empty text must leave nothing behind.
inline kainjow::mustache::data text_or_false(const std::string& text) {
  return text.empty() ? kainjow::mustache::data(false) : kainjow::mustache::data(text);
}

/// The data for the table's template: heading rows, cells with the text to show and the sort key,
/// notes.
kainjow::mustache::data table_data(const Table& table, const FigureContext& drawn,
                                   const HtmlOptions& options);

/// The data for the templates of a block. Every key that a template may use is set, since Mustache
/// would search enclosing contexts for a missing one.
/// @param section  Id of its section, which begins the ids within the block.
kainjow::mustache::data block_data(const Block& block, const FigureContext& drawn,
                                   const HtmlOptions& options, const std::string& section);

/// The items of the template of a few numbers.
kainjow::mustache::list highlight_items(const Highlights& highlights);

/// The phrases of a paragraph, for the template of that name.
kainjow::mustache::data phrases_data(const Paragraph& paragraph, const HtmlOptions& options);

/// Letters, digits and "-._/" stay, every other byte becomes %XX. Different texts stay different.
std::string percent_encoded(std::string_view text);

/// An http or https address as the target of a link; empty for any other text.
std::string web_link(const std::string& url);

/// A path relative to the page as the target of a link: never with another scheme or host.
std::string file_link(const std::string& path);

}  // namespace mapproof
