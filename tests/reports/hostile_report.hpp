#pragma once

#include <string>
#include <vector>

#include "reports/html/report_html.hpp"
#include "reports/model/report.hpp"

namespace mapproof::test {

/// A report whose every free text, tables and figures included, tries to be more than text.
struct HostileReport {
  Report report;
  std::vector<std::string> texts;       ///< All must be found in the page's text …
  std::vector<std::string> attributes;  ///< … or, these, in its attributes.
  std::vector<std::string> landmarks;   ///< Of the map "drawn", in the order of its rows.
  SvgLookup svg;                        ///< Draws that map alone.
};

HostileReport hostile_report();

}  // namespace mapproof::test
