#include "reports/html/report_html.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

#include "core/base/text/words.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/page_folds.hpp"
#include "reports/html/page_frame.hpp"
#include "reports/model/format.hpp"
#include "reports/model/page_text.hpp"

namespace mapproof {
namespace {

/// Findings of the first screen, and their characters where a figure is beside them; the others are
/// folded.
constexpr std::size_t kFindingsOfFirstScreen = 4;
constexpr std::size_t kCharactersOfFirstScreen = 560;

using kainjow::mustache::data;
using kainjow::mustache::list;

/// The command is part of the provenance, since it names a folder: equal reports stay equal
/// otherwise. The script builds each figure's command from it.
Block figure_command(const Report& report) {
  return KeyValues{{{"A figure alone", {report.figure_command + " ID", Emphasis::kCode}}}};
}

data section_data(const Section& section, const Report& report, const FigureContext& drawn,
                  const HtmlOptions& options, bool is_folded) {
  data out;
  out.set("folded", data(is_folded));
  out.set("id", section.id);
  out.set("title", page_text(section.title));
  out.set("study", text_or_false(section.group));
  list blocks;
  for (const Block& block : section.blocks)
    blocks.push_back(block_data(block, drawn, options, section.id));
  if (section.id.ends_with("provenance") && !report.figure_command.empty())
    blocks.push_back(block_data(figure_command(report), drawn, options, section.id));
  out.set("blocks", blocks);
  return out;
}

/// Adds a part of a section to the contents, unless it is named as the section is.
void add_part(const Section& section, std::string element, const std::string& title, list& parts) {
  if (title.empty() || title == section.title) return;
  data part;
  part.set("element", std::move(element));
  part.set("title", page_text(title_below(section.title, title)));
  parts.push_back(std::move(part));
}

/// The tables and figures of a section, those of a gallery that a page folds as one.
list parts_within(const Section& section) {
  list parts;
  for (const Block& block : section.blocks) {
    if (const auto* table = std::get_if<Table>(&block))
      add_part(section, "table-" + table->id, table->caption, parts);
    if (const auto* figure = std::get_if<FigureBlock>(&block))
      add_part(section, "figure-" + figure->id, figure->title, parts);
    const auto* gallery = std::get_if<Gallery>(&block);
    if (gallery == nullptr) continue;
    const std::size_t open = std::min(gallery->open, gallery->figures.size());
    for (const FigureBlock& figure : std::span(gallery->figures).first(open))
      add_part(section, "figure-" + figure.id, figure.title, parts);
    if (open < gallery->figures.size())
      add_part(section, "figure-" + gallery->figures[open].id, folded_words(*gallery), parts);
  }
  return parts;
}

/// Two levels: studies and their sections, or sections and their parts.
list contents(const Report& report) {
  list groups;
  for (std::size_t i = 0; i < report.sections.size();) {
    const Section& first = report.sections[i];
    list entries;
    for (; i < report.sections.size() && report.sections[i].group == first.group; ++i) {
      data entry;
      entry.set("id", report.sections[i].id);
      entry.set("title", page_text(report.sections[i].title));
      const list parts = first.group.empty() ? parts_within(report.sections[i]) : list();
      entry.set("any_parts", data(!parts.empty()));
      entry.set("parts", parts);
      entries.push_back(std::move(entry));
    }
    data group;
    group.set("group", text_or_false(first.group));
    group.set("entries", entries);
    groups.push_back(std::move(group));
  }
  return groups;
}

data standing_data(const Standing& standing, const HtmlOptions& options) {
  data out;
  out.set("worse", data(standing.worse));
  out.set("title", standing.title);
  list sentences;
  for (const std::string& sentence : standing.sentences)
    sentences.push_back(data("sentence", page_text(sentence)));
  out.set("sentences", sentences);
  list rest;
  for (const Paragraph& paragraph : standing.rest)
    rest.push_back(data("phrases", phrases_data(paragraph, options)));
  out.set("rest", rest);
  out.set("note", text_or_false(page_text(standing.note)));
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
  out.set("title", page_text(figure.title));
  out.set("alt", figure.alt);
  return out;
}

/// The link to the figure of the first screen, with what got worse in it.
data main_figure_link(const FigureBlock& figure, const FigureContext& drawn) {
  data out = figure_link(figure);
  out.set("regressed", text_or_false(figure.regressed));
  out.set("ringed", data(!figure.regressed.empty() && marked_drawing(figure, drawn).ringed));
  return out;
}

/// What a small image is called: a long title without what was found, or only as far as what its
/// figure shows.
std::string short_title(const std::string& title) {
  constexpr std::size_t kMost = 42;
  const std::string subject =
      title.substr(0, title.size() <= kMost ? title.npos : title.rfind(": "));
  if (subject.size() <= kMost) return subject;
  return title.substr(0, std::min({title.find(": "), title.find(" ("), title.find(" · ")}));
}

/// The gallery that a figure stands in, or the figure itself: figures of one kind are a family, 3-D
/// ones each their own.
const void* family_of(const Report& report, const FigureBlock& figure) {
  if (figure.value == "scene") return &figure;
  for (const Section& section : report.sections)
    for (const Block& block : section.blocks)
      if (const auto* gallery = std::get_if<Gallery>(&block))
        for (const FigureBlock& own : gallery->figures)
          if (&own == &figure) return gallery;
  return &figure;
}

/// The kinds of figures, in the order in which small images come.
enum class ImageKind { kSpace, kMap, kCurves };

ImageKind image_kind_of(const FigureBlock& figure) {
  if (figure.value == "scene") return ImageKind::kSpace;
  return figure.is_map ? ImageKind::kMap : ImageKind::kCurves;
}

/// A small image, and what it is called.
struct Thumbnail {
  const FigureBlock* figure;
  std::string title;
};

/// The first of each kind before any other.
void each_kind_once(std::vector<Thumbnail>& all) {
  auto rest = all.begin();
  for (const ImageKind kind : {ImageKind::kSpace, ImageKind::kMap, ImageKind::kCurves}) {
    const auto found = std::find_if(
        rest, all.end(), [&](const Thumbnail& one) { return image_kind_of(*one.figure) == kind; });
    if (found == all.end()) continue;
    std::rotate(rest, found, found + 1);
    ++rest;
  }
}

/// A few figures of the opening, no two of one family. A small image is of a figure's first panel:
/// none shows what the large figure or another small image shows. Where its short title is that of
/// another, it has the whole one, which says in what they differ.
list thumbnails(const Report& report) {
  constexpr std::size_t kMost = 6;
  std::vector<Thumbnail> all;
  std::set<std::string> titles;
  std::set<const void*> families;
  std::set<std::uint64_t> panels;
  const FigureBlock* main_figure = figure_of(report, report.opening.main_figure);
  if (main_figure != nullptr) {
    panels.insert(main_figure->shows.begin(), main_figure->shows.end());
    titles = {main_figure->title, short_title(main_figure->title)};
  }
  for (const std::string& id : report.opening.figure_ids) {
    const FigureBlock* figure = figure_of(report, id);
    if (figure == nullptr || figure == main_figure) continue;
    std::string title = short_title(figure->title);
    if (titles.contains(title)) title = figure->title;
    const void* family = family_of(report, *figure);
    const std::uint64_t panel = figure->shows.empty() ? 0 : figure->shows.front();
    if (titles.contains(title) || families.contains(family)) continue;
    if (panel != 0 && !panels.insert(panel).second) continue;
    titles.insert(title);
    families.insert(family);
    all.push_back({figure, std::move(title)});
  }
  each_kind_once(all);
  all.resize(std::min(all.size(), kMost));
  list shown;
  for (const Thumbnail& one : all) {
    data link = figure_link(*one.figure);
    link.set("title", one.title);
    shown.push_back(std::move(link));
  }
  return shown;
}

/// The section that says how to make the report again; empty if there is none.
std::string provenance_of(const Report& report) {
  const auto found = std::ranges::find_if(
      report.sections, [](const Section& section) { return section.id.ends_with("provenance"); });
  return found == report.sections.end() ? "" : found->id;
}

/// A text of a first screen, and what is left of it: the sentences that fit in a few lines, the
/// first one at least.
std::pair<std::string, std::string> first_sentences(const std::string& text) {
  constexpr std::size_t kMost = 240;
  std::size_t end = text.size();
  for (std::size_t at = 0; text.size() > kMost && at + 1 < text.size(); ++at) {
    const bool ends = (text[at] == '.' || text[at] == '?') && text[at + 1] == ' ';
    if (ends && (end == text.size() || at < kMost)) end = at + 1;
  }
  return {text.substr(0, end), end < text.size() ? text.substr(end + 1) : ""};
}

/// What stands after a word that begins it; none if it is empty.
std::vector<Paragraph> headed(const std::string& word, const Paragraph& said) {
  if (said.phrases.empty()) return {};
  Paragraph all{{strong(word)}};
  all.phrases.insert(all.phrases.end(), said.phrases.begin(), said.phrases.end());
  return {all};
}

void set_opening(data& page, const Report& report, const FigureContext& drawn,
                 const HtmlOptions& options) {
  const Opening& opening = report.opening;
  list findings, folded;
  std::vector<Paragraph> all = opening.findings;
  const auto [asked, more] = first_sentences(opening.question);
  if (!asked.empty()) all.insert(all.begin(), Paragraph{{phrase(asked)}});
  if (!more.empty()) all.push_back(Paragraph{{phrase(more)}});
  // What is wrong and what the study is compared with are seen without a click, after what was
  // done.
  std::vector<Paragraph> always = headed("Warnings", opening.wrong);
  std::ranges::move(headed("Compared with", opening.compared_with), std::back_inserter(always));
  const std::size_t begin = std::min<std::size_t>(1, all.size()), end = begin + always.size();
  all.insert(all.begin() + static_cast<std::ptrdiff_t>(begin), always.begin(), always.end());
  std::size_t characters = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    characters += characters_of(all[i]);
    const bool is_open =
        (i >= begin && i < end) || (folded.empty() && findings.size() < kFindingsOfFirstScreen &&
                                    (findings.empty() || characters <= kCharactersOfFirstScreen));
    (is_open ? findings : folded).push_back(data("phrases", phrases_data(all[i], options)));
  }
  page.set("any_opening",
           data(!all.empty() || !opening.figure_ids.empty() || !opening.numbers.items.empty() ||
                !opening.main_figure.empty() || opening.standing || !opening.other_pages.empty()));
  page.set("highlights", opening.numbers.items.empty()
                             ? data(false)
                             : data("items", highlight_items(opening.numbers)));
  page.set("standing", opening.standing ? standing_data(*opening.standing, options) : data(false));
  page.set("findings", findings);
  page.set("folded", folded);
  page.set("any_folded", data(!folded.empty()));
  page.set("folded_words", counted(static_cast<long long>(folded.size()), "more finding"));
  const FigureBlock* main_figure = figure_of(report, opening.main_figure);
  page.set("main_figure",
           main_figure == nullptr ? data(false) : main_figure_link(*main_figure, drawn));
  const list small = thumbnails(report);
  page.set("any_thumbnails", data(!small.empty()));
  page.set("any_images", data(main_figure != nullptr || !small.empty()));
  page.set("thumbnails", small);
  page.set("other_pages", text_or_false(opening.other_pages));
}

}  // namespace

std::string report_html(const Report& whole, const Templates& templates, const SvgLookup& svg,
                        const HtmlOptions& options) {
  check(whole);
  Report report = whole;
  const std::set<const Section*> folded = fold_to_screens(report);
  data page;
  page.set("title", report.title);
  page.set("subtitle", page_text(report.subtitle));
  page.set("footer", report.footer);
  page.set("date", text_or_false(report.date));
  page.set("provenance", text_or_false(provenance_of(report)));
  set_page_frame(page, "report", templates);
  const FigureContext drawn{.svg = svg, .notes = first_notes(report)};
  set_opening(page, report, drawn, options);
  list sections;
  for (const Section& section : report.sections)
    sections.push_back(section_data(section, report, drawn, options, folded.contains(&section)));
  page.set("sections", sections);
  page.set("contents", contents(report));
  return rendered("report", templates, page);
}

}  // namespace mapproof
