#include "reports/history/nightly_standing.hpp"

#include <algorithm>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/slug.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

/// What, by how much, since when, and in which commits.
std::string sentence_of(const FindingGroup& group) {
  std::string text = group.setup.empty() ? "" : group.setup + ", ";
  text += fmt::format("{}, since nightly run {}", group.headline(), group.commits.since.number);
  if (group.commits.has_commits()) text += ", commits " + group.commits.text();
  return text + (group.known ? "; known: " + group.known->text : ".");
}

/// @param before  Put before each sentence.
void add_findings(std::span<const FindingGroup> groups, const std::string& study,
                  const std::string& before, Standing& standing) {
  std::size_t count = 0;
  for (const FindingGroup& group : groups)
    if (group.study == study && ++count <= kMostReported)
      standing.sentences.push_back(before + sentence_of(group));
  if (count > kMostReported)
    standing.sentences.push_back(fmt::format("{}{} {} more, among the findings of its trends.",
                                             before, before.empty() ? "And" : "and",
                                             count - kMostReported));
}

/// The studies that have findings, in the order of these.
std::vector<std::string> studies_of(std::span<const FindingGroup> groups) {
  std::vector<std::string> studies;
  for (const FindingGroup& group : groups)
    if (std::ranges::find(studies, group.study) == studies.end()) studies.push_back(group.study);
  return studies;
}

}  // namespace

Standing study_standing(const NightlyFacts& nightly_run, std::span<const FindingGroup> groups,
                        const std::string& study, bool is_compared) {
  Standing result;
  add_findings(groups, study, "", result);
  long long count = 0, known = 0;
  for (const FindingGroup& group : groups)
    if (group.study == study) (group.known ? known : count) += std::ssize(group.numbers);
  result.worse = count > 0;
  const std::string this_run = fmt::format("Nightly run {}: ", nightly_run.number);
  if (result.worse)
    result.title = this_run + counted(count, "thing") + " got worse";
  else if (is_compared && nightly_run.reference)
    result.title =
        this_run + fmt::format("nothing {}got worse than in nightly run {}", known > 0 ? "new " : "",
                               *nightly_run.reference);
  else
    result.title = this_run + "not compared: no nightly run to compare with has the same settings";
  return result;
}

Standing nightly_standing(const NightlySummary& summary) {
  Standing result;
  for (const std::string& study : studies_of(summary.groups))
    add_findings(summary.groups, study, study + ": ", result);
  result.worse = summary.new_findings() > 0;
  result.title = summary.title();
  return result;
}

namespace {

/// Adds a text to others that are kept apart by "; ", once.
void add(std::string& all, const std::string& text) {
  if (all.find(text) != std::string::npos) return;
  all += (all.empty() ? "" : "; ") + text;
}

bool holds(const std::vector<std::string>& texts, const std::string& text) {
  return std::ranges::find(texts, text) != texts.end();
}

std::vector<std::string> texts_of(const Row& row) {
  std::vector<std::string> texts;
  for (const Cell& cell : row.cells)
    if (const auto* text = std::get_if<TextCell>(&cell)) texts.push_back(text->text);
  return texts;
}

/// The values of a setting's levels: "0.1" and "2" of "noise=0.1 pace=2"; none of "K = 6".
std::vector<std::string> level_values(const std::string& setting) {
  std::vector<std::string> values;
  for (std::size_t is = setting.find('='); is != std::string::npos; is = setting.find('=', is + 1))
    if (is > 0 && setting[is - 1] != ' ')
      values.push_back(setting.substr(is + 1, setting.find(' ', is) - is - 1));
  return values;
}

/// Whether a text has the value as a word of its own: "noise 0.1" has "0.1", "noise 0.15" has not.
bool has_word(const std::string& text, const std::string& value) {
  constexpr std::string_view kEnds = " ,:;=()[]\u00A0";
  const auto ends = [&](std::size_t at) {
    return at >= text.size() || kEnds.find(text[at]) != std::string_view::npos;
  };
  for (std::size_t at = text.find(value); at != std::string::npos; at = text.find(value, at + 1))
    if ((at == 0 || ends(at - 1)) && ends(at + value.size())) return true;
  return false;
}

/// Whether a table shows a setting's levels: in a cell of the row, as the title of a column, or in
/// its caption.
bool shows_levels(const Table& table, const std::vector<std::string>& row,
                  const std::string& setting) {
  const std::vector<std::string> values = level_values(setting);
  return !values.empty() && std::ranges::all_of(values, [&](const std::string& value) {
    return holds(row, value) || has_word(table.caption, value) ||
           std::ranges::find(table.columns, value, &Column::title) != table.columns.end();
  });
}

/// Whether a row is about the method with one of its settings: "ISOMAP, K = 6", "ISOMAP" and
/// "K = 6", or "MCL" in a table of the levels.
bool names_method(const Table& table, const Row& row, const FindingGroup& group) {
  const std::vector<std::string> texts = texts_of(row);
  const auto is_there = [&](const std::string& text) { return holds(texts, text); };
  if (std::ranges::any_of(group.lines, is_there)) return true;
  return is_there(group.method) && std::ranges::any_of(group.settings, [&](const auto& setting) {
           return is_there(setting) || shows_levels(table, texts, setting);
         });
}

/// Whether the table's columns are levels, of which a row has several.
bool has_level_columns(const Table& table, const FindingGroup& group) {
  return std::ranges::any_of(group.settings, [&](const std::string& setting) {
    return std::ranges::any_of(level_values(setting), [&](const std::string& value) {
      return std::ranges::find(table.columns, value, &Column::title) != table.columns.end();
    });
  });
}

/// Whether a table is about the setup: its caption, its id or a cell names it.
bool is_of_setup(const Table& table, const Row& row, const std::string& setup) {
  if (setup.empty()) return true;
  const std::string wanted = lower_case(setup);
  return lower_case(table.caption).find(wanted) != std::string::npos ||
         table.id.find(slug_of(setup)) != std::string::npos ||
         std::ranges::any_of(texts_of(row),
                             [&](const std::string& text) { return lower_case(text) == wanted; });
}

/// Whether one of the table's columns shows the quantity.
bool shows_quantity(const Table& table, const std::string& quantity) {
  const auto has = [&](const std::string& text) { return text.find(quantity) != std::string::npos; };
  return has(table.caption) || std::ranges::any_of(table.columns, [&](const Column& column) {
           return has(column.title) || has(column.group) || has(column.tooltip);
         });
}

void mark_table(Table& table, const FindingGroup& group) {
  if (!shows_quantity(table, group.quantity)) return;
  for (Row& row : table.rows)
    if (names_method(table, row, group) && is_of_setup(table, row, group.setup))
      add(row.regressed,
          has_level_columns(table, group) ? group.change_of_settings() : group.change_text());
}

std::string label_of(const Layer& layer) {
  return std::visit(
      [](const auto& one) -> std::string {
        if constexpr (requires { std::string(one.label); })
          return one.label;
        else
          return "";
      },
      layer);
}

bool draws(const Figure& figure, const FindingGroup& group) {
  bool quantity = figure.title.find(group.quantity) != std::string::npos;
  bool method = false;
  for (const Panel& panel : figure.panels) {
    quantity = quantity || panel.y.label.find(group.quantity) != std::string::npos;
    for (const Layer& layer : panel.layers) {
      const std::string label = label_of(layer);
      method = method || (!label.empty() && (label == group.method ||
                                             std::ranges::find(group.lines, label) !=
                                                 group.lines.end()));
    }
  }
  return quantity && method;
}

void mark_figure(FigureBlock& block, std::span<const Figure> figures, const FindingGroup& group) {
  const auto figure = std::ranges::find(figures, block.id, &Figure::id);
  if (figure != figures.end() && draws(*figure, group)) add(block.regressed, group.headline());
}

void mark_block(Block& block, std::span<const Figure> figures, const FindingGroup& group) {
  if (auto* table = std::get_if<Table>(&block)) mark_table(*table, group);
  if (auto* figure = std::get_if<FigureBlock>(&block)) mark_figure(*figure, figures, group);
  if (auto* gallery = std::get_if<Gallery>(&block))
    for (FigureBlock& one : gallery->figures) mark_figure(one, figures, group);
}

}  // namespace

void mark_regressed(Report& report, std::span<const Figure> figures,
                    std::span<const FindingGroup> groups, const std::string& study) {
  for (const FindingGroup& group : groups)
    if (group.study == study)
      for (Section& section : report.sections)
        for (Block& block : section.blocks) mark_block(block, figures, group);
}

}  // namespace mapproof
