#pragma once

#include <string>

#include <kainjow/mustache.hpp>

#include "reports/html/report_html.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// The text, or false where an empty one shall leave nothing behind.
inline kainjow::mustache::data text_or_false(const std::string& text) {
  return text.empty() ? kainjow::mustache::data(false) : kainjow::mustache::data(text);
}

/// What the table's template is told: heading rows, cells with the text to show and the key to sort
/// by, notes.
kainjow::mustache::data table_data(const Table& table, const HtmlOptions& options);

}  // namespace mapproof
