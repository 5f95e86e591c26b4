#include "reports/html/report_html.hpp"

#include <kainjow/mustache.hpp>

#include "core/base/errors.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/escape.hpp"
#include "reports/html/sha256.hpp"
#include "reports/html/template_check.hpp"

namespace mapproof {
namespace {

using kainjow::mustache::data;
using kainjow::mustache::list;

/// What the page may do: its own style sheet and script, images within it, nothing else.
std::string policy(const std::string& style, const std::string& script) {
  return "default-src 'none'; style-src '" + policy_hash(style) + "'; script-src '" +
         policy_hash(script) + "'; img-src data:; base-uri 'none'; form-action 'none'";
}

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
  const std::string& style = templates.files.at("report.css");
  const std::string& script = templates.files.at("report.js");
  data page;
  page.set("title", report.title);
  page.set("subtitle", report.subtitle);
  page.set("footer", report.footer);
  page.set("policy", policy(style, script));
  page.set("style_element", "<style>" + style + "</style>");
  page.set("script_element", "<script>" + script + "</script>");
  list sections;
  for (const Section& section : report.sections)
    sections.push_back(section_data(section, svg, options));
  page.set("sections", sections);

  kainjow::mustache::mustache root(assembled("report.mustache", templates.files));
  root.set_custom_escape(html_escaped);
  std::string html = root.render(page);
  if (!root.is_valid())
    throw IoError(templates.sources.at("report.mustache"), root.error_message());
  return html;
}

}  // namespace mapproof
