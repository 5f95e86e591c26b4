#include "reports/html/report_html.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <kainjow/mustache.hpp>

#include "core/base/text/words.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/page_frame.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

/// Findings of the first screen, and their characters where a figure is beside them; the others are
/// folded.
constexpr std::size_t kFindingsOfFirstScreen = 4;
constexpr std::size_t kCharactersOfFirstScreen = 560;

using kainjow::mustache::data;
using kainjow::mustache::list;

/// Heights in pixels on a page 1280 wide, measured on the pages of every kind of study.
namespace height {
constexpr double kMost = 12.75 * 800;  ///< Of what is open: about fifteen screens with the opening.
constexpr double kSection = 105, kFold = 42, kText = 30, kLine = 24;
constexpr double kTable = 165, kRow = 36, kFigure = 530, kWideFigure = 860;
constexpr std::size_t kCharacters = 105;  ///< Of a line of text.
}  // namespace height

std::size_t characters_of(const Paragraph& paragraph) {
  std::size_t size = 0;
  for (const Phrase& phrase : paragraph.phrases) size += phrase.text.size();
  return size;
}

double height_of(const Paragraph& paragraph) {
  return height::kText +
         height::kLine * static_cast<double>(characters_of(paragraph) / height::kCharacters);
}

double height_of(const Table& table) {
  if (table.secondary || table.rows.size() > kMostRowsOpen) return height::kFold;
  return height::kTable + height::kRow * static_cast<double>(table.rows.size()) +
         height::kLine * static_cast<double>(table.notes.size());
}

double height_of(const Gallery& gallery) {
  double narrow = 0.0, all = 0.0;
  const std::size_t shown = std::min(gallery.open, gallery.figures.size());
  for (std::size_t i = 0; i < shown; ++i)
    (gallery.figures[i].wide ? all : narrow) +=
        gallery.figures[i].wide ? height::kWideFigure : height::kFigure;
  all += std::ceil(narrow / height::kFigure / 2.0) * height::kFigure;  // Two stand side by side.
  return all + (shown < gallery.figures.size() ? height::kFold : 0.0);
}

double height_of(const Block& block) {
  if (const auto* paragraph = std::get_if<Paragraph>(&block)) return height_of(*paragraph);
  if (const auto* table = std::get_if<Table>(&block)) return height_of(*table);
  if (const auto* gallery = std::get_if<Gallery>(&block)) return height_of(*gallery);
  if (std::holds_alternative<FigureBlock>(block)) return height::kFigure;
  double all = 0.0;
  if (const auto* bullets = std::get_if<BulletList>(&block))
    for (const Paragraph& item : bullets->items) all += height_of(item);
  else if (const auto* facts = std::get_if<KeyValues>(&block))
    all = 1.25 * height::kRow * static_cast<double>(facts->items.size());
  else if (const auto* statuses = std::get_if<StatusList>(&block))
    all = height::kTable + height::kRow * static_cast<double>(statuses->items.size());
  else
    all = 3.0 * height::kText;
  return all;
}

using Folded = std::set<const Section*>;

double height_of(const Report& report, const Folded& folded) {
  double all = 0.0;
  for (const Section& section : report.sections) {
    all += folded.contains(&section) ? height::kFold : height::kSection;
    if (!folded.contains(&section))
      for (const Block& block : section.blocks) all += height_of(block);
  }
  return all;
}

bool is_regressed(const Table& table) {
  return std::ranges::any_of(table.rows, [](const Row& row) { return !row.regressed.empty(); });
}

/// How many figures of a gallery stay open at least: up to the last that shows what got worse.
std::size_t least_open(const Gallery& gallery) {
  for (std::size_t i = gallery.figures.size(); i > 0; --i)
    if (!gallery.figures[i - 1].regressed.empty()) return i;
  return 0;
}

bool shows_regression(const Section& section) {
  return std::ranges::any_of(section.blocks, [](const Block& block) {
    const auto* table = std::get_if<Table>(&block);
    const auto* gallery = std::get_if<Gallery>(&block);
    return (table != nullptr && is_regressed(*table)) ||
           (gallery != nullptr && least_open(*gallery) > 0);
  });
}

/// Folds the tables of each section from its `tables`-th on, and what is over `figures` of each
/// gallery.
void fold_beyond(Report& report, std::size_t tables, std::size_t figures) {
  for (Section& section : report.sections) {
    std::size_t seen = 0;
    for (Block& block : section.blocks) {
      if (auto* table = std::get_if<Table>(&block);
          table != nullptr && seen++ >= tables && !is_regressed(*table))
        table->secondary = true;
      if (auto* gallery = std::get_if<Gallery>(&block))
        gallery->open = std::min(gallery->open, std::max(figures, least_open(*gallery)));
    }
  }
}

/// The sections that can be folded, in the order in which that happens: the last of each study
/// first. The first section of a study, and what has no group but one section, stay.
std::vector<const Section*> foldable(const Report& report) {
  std::map<std::string, std::vector<const Section*>> groups;
  for (const Section& section : report.sections) groups[section.group].push_back(&section);
  std::size_t most = 0;
  for (const auto& [group, sections] : groups) most = std::max(most, sections.size());
  std::vector<const Section*> all;
  for (std::size_t size = most; size > 1; --size)
    for (const auto& [group, sections] : groups)
      if (sections.size() >= size && !shows_regression(*sections[size - 1]))
        all.push_back(sections[size - 1]);
  return all;
}

/// Folds what few readers open, until a page has some fifteen screens: secondary tables, then
/// figures behind the first ones of each gallery, then whole sections. What got worse stays open.
/// @return The sections that are folded as a whole.
Folded fold_to_screens(Report& report) {
  constexpr std::pair<std::size_t, std::size_t> kSteps[] = {{2, 6}, {1, 4}, {1, 2}, {0, 2}, {0, 1}};
  for (const auto& [tables, figures] : kSteps) {
    if (height_of(report, {}) <= height::kMost) return {};
    fold_beyond(report, tables, figures);
  }
  Folded folded;
  for (const Section* section : foldable(report)) {
    if (height_of(report, folded) <= height::kMost) break;
    folded.insert(section);
  }
  return folded;
}

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

/// A text of a first screen, and what is left of it: the sentences that fit in a few lines, the
/// first one at least.
std::pair<std::string, std::string> first_sentences(const std::string& text) {
  constexpr std::size_t kMost = 240;
  std::size_t end = text.size();
  for (std::size_t at = 0; text.size() > kMost && at + 1 < text.size(); ++at) {
    const bool ends =
        (text[at] == '.' || text[at] == '?' || text[at] == ';') && text[at + 1] == ' ';
    if (ends && (end == text.size() || at < kMost)) end = at + 1;
  }
  return {text.substr(0, end), end < text.size() ? text.substr(end + 1) : ""};
}

void set_opening(data& page, const Report& report, const std::string& linked,
                 const HtmlOptions& options) {
  const Opening& opening = report.opening;
  list findings, folded;
  std::vector<Paragraph> all = opening.findings;
  const auto [asked, more] = first_sentences(opening.question);
  if (!asked.empty()) all.insert(all.begin(), Paragraph{{phrase(asked)}});
  const auto is_warning = [](const Paragraph& finding) {
    return !finding.phrases.empty() && finding.phrases.front().text == "Warnings";
  };
  // What is wrong is seen without a click, after what was done.
  if (all.size() > 2) std::ranges::stable_partition(all.begin() + 1, all.end(), is_warning);
  if (!more.empty()) all.push_back(Paragraph{{phrase(more)}});
  std::size_t characters = 0;
  for (const Paragraph& finding : all) {
    characters += characters_of(finding);
    const bool is_open =
        is_warning(finding) || (folded.empty() && findings.size() < kFindingsOfFirstScreen &&
                                (findings.empty() || characters <= kCharactersOfFirstScreen));
    (is_open ? findings : folded).push_back(data("phrases", phrases_data(finding, options)));
  }
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

std::string report_html(const Report& whole, const Templates& templates, const SvgLookup& svg,
                        const HtmlOptions& options) {
  check(whole);
  Report report = whole;
  const Folded folded = fold_to_screens(report);
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
    sections.push_back(section_data(section, report, drawn, options, folded.contains(&section)));
  page.set("sections", sections);
  page.set("contents", contents(report));
  return rendered("report", templates, page);
}

}  // namespace mapproof
