#include "reports/html/report_html.hpp"

#include <kainjow/mustache.hpp>

#include "reports/html/block_data.hpp"
#include "reports/html/page_frame.hpp"

namespace mapproof {
namespace {

using kainjow::mustache::data;
using kainjow::mustache::list;

data section_data(const Section& section, const SvgLookup& svg, const HtmlOptions& options) {
  data out;
  out.set("id", section.id);
  out.set("title", section.title);
  list blocks;
  for (const Block& block : section.blocks) blocks.push_back(block_data(block, svg, options));
  out.set("blocks", blocks);
  return out;
}

}  // namespace

std::string report_html(const Report& report, const Templates& templates, const SvgLookup& svg,
                        const HtmlOptions& options) {
  check(report);
  data page;
  page.set("title", report.title);
  page.set("subtitle", report.subtitle);
  page.set("footer", report.footer);
  set_page_frame(page, "report", templates);
  list sections;
  for (const Section& section : report.sections)
    sections.push_back(section_data(section, svg, options));
  page.set("sections", sections);
  return rendered("report", templates, page);
}

}  // namespace mapproof
