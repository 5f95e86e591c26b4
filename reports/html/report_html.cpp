#include "reports/html/report_html.hpp"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

#include "core/base/text/words.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/page_frame.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kFindingsOfFirstScreen =
    3;  ///< The others are folded: the figure comes next.

using kainjow::mustache::data;
using kainjow::mustache::list;

/// The command is part of the provenance, since it names a folder: equal reports stay equal
/// otherwise. The script builds each figure's command from it.
Block figure_command(const Report& report) {
  return KeyValues{{{"A figure alone", {report.figure_command + " ID", Emphasis::kCode}}}};
}

data section_data(const Section& section, const Report& report, const FigureContext& drawn,
                  const HtmlOptions& options) {
  data out;
  out.set("id", section.id);
  out.set("title", section.title);
  out.set("study", text_or_false(section.group));
  list blocks;
  for (const Block& block : section.blocks)
    blocks.push_back(block_data(block, drawn, options, section.id));
  if (section.id.ends_with("provenance") && !report.figure_command.empty())
    blocks.push_back(block_data(figure_command(report), drawn, options, section.id));
  out.set("blocks", blocks);
  return out;
}

/// The sections, those of one study under its name.
list contents(const Report& report) {
  list groups;
  for (std::size_t i = 0; i < report.sections.size();) {
    const Section& first = report.sections[i];
    list entries;
    for (; i < report.sections.size() && report.sections[i].group == first.group; ++i) {
      data entry;
      entry.set("id", report.sections[i].id);
      entry.set("title", report.sections[i].title);
      entries.push_back(std::move(entry));
    }
    data group;
    group.set("group", text_or_false(first.group));
    group.set("entries", entries);
    groups.push_back(std::move(group));
  }
  return groups;
}

data standing_data(const Standing& standing) {
  data out;
  out.set("worse", data(standing.worse));
  out.set("title", standing.title);
  list sentences;
  for (const std::string& sentence : standing.sentences)
    sentences.push_back(data("sentence", sentence));
  out.set("sentences", sentences);
  return out;
}

const FigureBlock* figure_of(const Report& report, const std::string& id) {
  const auto all = figures(report);
  const auto found = std::ranges::find(all, id, &FigureBlock::id);
  return found == all.end() ? nullptr : *found;
}

/// A link to a figure; the script puts an image of an embedded figure into it.
data figure_link(const FigureBlock& figure) {
  data out;
  out.set("id", figure.id);
  out.set("title", figure.title);
  out.set("alt", figure.alt);
  return out;
}

list thumbnails(const Report& report) {
  list shown;
  for (const std::string& id : report.opening.figure_ids)
    if (const FigureBlock* figure = figure_of(report, id)) shown.push_back(figure_link(*figure));
  return shown;
}

/// "12 of 340 figures are not in this page …"; empty if all are.
std::string linked_words(const Report& report, std::size_t linked, const HtmlOptions& options) {
  if (linked == 0) return "";
  const std::string where = options.figure_folder.empty()
                                ? "They are left out."
                                : "They are linked, in " + options.figure_folder + "/ next to it.";
  return fmt::format("{} of {} are not in this page, which holds {} MB of drawings at most. {}",
                     linked, counted(std::ssize(figures(report)), "figure"),
                     format_number(static_cast<double>(options.drawing_bytes) / 1e6, 1), where);
}

/// The section that says how to make the report again; empty if there is none.
std::string provenance_of(const Report& report) {
  const auto found = std::ranges::find_if(
      report.sections, [](const Section& section) { return section.id.ends_with("provenance"); });
  return found == report.sections.end() ? "" : found->id;
}

void set_opening(data& page, const Report& report, const std::string& linked,
                 const HtmlOptions& options) {
  const Opening& opening = report.opening;
  list findings, folded;
  std::vector<Paragraph> all = opening.findings;
  if (!opening.question.empty()) all.insert(all.begin(), Paragraph{{phrase(opening.question)}});
  for (const Paragraph& finding : all)
    (findings.size() < kFindingsOfFirstScreen ? findings : folded)
        .push_back(data("phrases", phrases_data(finding, options)));
  page.set("any_opening", data(!all.empty() || !opening.figure_ids.empty() ||
                               !opening.numbers.items.empty() || !opening.main_figure.empty() ||
                               opening.standing || !linked.empty()));
  page.set("highlights", opening.numbers.items.empty()
                             ? data(false)
                             : data("items", highlight_items(opening.numbers)));
  page.set("standing", opening.standing ? standing_data(*opening.standing) : data(false));
  page.set("findings", findings);
  page.set("folded", folded);
  page.set("any_folded", data(!folded.empty()));
  page.set("folded_words", counted(static_cast<long long>(folded.size()), "more finding"));
  const FigureBlock* main_figure = figure_of(report, opening.main_figure);
  page.set("main_figure", main_figure == nullptr ? data(false) : figure_link(*main_figure));
  page.set("any_thumbnails", data(!opening.figure_ids.empty()));
  page.set("any_images", data(main_figure != nullptr || !opening.figure_ids.empty()));
  page.set("thumbnails", thumbnails(report));
  page.set("linked_words", text_or_false(linked));
}

}  // namespace

std::string report_html(const Report& report, const Templates& templates, const SvgLookup& svg,
                        const HtmlOptions& options) {
  check(report);
  data page;
  page.set("title", report.title);
  page.set("subtitle", report.subtitle);
  page.set("footer", report.footer);
  page.set("date", text_or_false(report.date));
  page.set("provenance", text_or_false(provenance_of(report)));
  set_page_frame(page, "report", templates);
  const FigureContext drawn{.svg = svg,
                            .linked = linked_figures(report, svg, options.drawing_bytes),
                            .notes = first_notes(report)};
  set_opening(page, report, linked_words(report, drawn.linked.size(), options), options);
  list sections;
  for (const Section& section : report.sections)
    sections.push_back(section_data(section, report, drawn, options));
  page.set("sections", sections);
  page.set("contents", contents(report));
  return rendered("report", templates, page);
}

}  // namespace mapproof
