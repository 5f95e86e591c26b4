#pragma once

#include <kainjow/mustache.hpp>

#include "reports/html/report_html.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// What the table's template is told: heading rows, cells with the text to show and the key to sort
/// by, notes.
kainjow::mustache::data table_data(const Table& table, const HtmlOptions& options);

}  // namespace mapproof
