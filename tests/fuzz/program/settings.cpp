// Settings, approvals, templates, and texts that become parts of pages and drawings.
#include "core/json/record_writer.hpp"
#include "render/svg/svg.hpp"
#include "reports/diff/approvals/approvals.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/svg/svg_parser.hpp"
#include "reports/history/history_prune.hpp"
#include "reports/history/nightly_notes.hpp"
#include "reports/history/nightly_scores.hpp"
#include "reports/html/report_html.hpp"
#include "reports/html/template_check.hpp"
#include "reports/html/templates.hpp"
#include "reports/model/format.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"

namespace mapproof::fuzz {
namespace {

const Added kSettings({.name = "diff-settings",
                       .run = [](auto bytes) { parse_diff_settings(bytes, kSource); }});
const Added kApprovals({.name = "approvals", .run = [](auto bytes) {
                          round_trip(
                              bytes, parse_approvals, [](const std::vector<std::string>& ids) {
                                return to_json_text(
                                    ApprovalsFile{.baseline = {}, .current = {}, .ids = ids});
                              });
                        }});
const Added kPrune({.name = "prune-rule",
                    .run = [](auto bytes) { parse_prune_rule(std::string(bytes)); }});
const Added kNoteTarget({.name = "note-target", .run = [](auto bytes) {
                           parse_note_target(std::string(bytes), "--note");
                         }});
const Added kOrder({.name = "experiment-digest",
                    .run = [](auto bytes) { experiment_digest(std::string(bytes), kSource); },
                    .seeds = {"study/study.json"}});

/// The page of a report by a template of the user's, beside empty ones.
void make_page(std::string_view bytes) {
  static const Templates usual = load_templates();
  Templates templates = usual;
  for (auto& [name, text] : templates.files) text = "";
  templates.files["report.mustache"] = bytes;
  check_templates(templates.files, templates.sources);
  const Report report{.title = "a < b & \"c\"",
                      .subtitle = "{{title}}",
                      .sections = {{.id = "one", .title = "</script>", .blocks = {}}},
                      .footer = ""};
  report_html(report, templates, {});
}
const Added kTemplate({.name = "template", .run = make_page});

/// No text ends or begins an element of a page or a drawing.
void show_text(std::string_view bytes) {
  const std::string escaped = html_escaped(std::string(bytes));
  if (escaped.find_first_of("<>\"'") != std::string::npos) found("no markup in a page", escaped);
  std::string xml;
  append_xml(xml, bytes);
  try {
    parse_svg("<svg xmlns=\"http://www.w3.org/2000/svg\"><text id=\"a\">" + xml + "</text></svg>");
  } catch (const std::exception& error) {
    found("a text in a drawing is read", error.what());
  }
}
const Added kText({.name = "text", .run = show_text});

}  // namespace
}  // namespace mapproof::fuzz
