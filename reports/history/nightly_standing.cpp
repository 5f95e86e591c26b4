#include "reports/history/nightly_standing.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/slug.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

/// "both findings", "2 of the 3 findings": how many of all that are new a group has; empty for one.
std::string share_words(std::size_t own, std::size_t all) {
  if (own < 2) return "";
  if (own < all) return fmt::format("{} of the {} findings", own, all);
  return own == 2 ? "both findings" : fmt::format("all {} findings", own);
}

/// Between which nightly runs, and how to list the commits.
std::string range_words(const CommitRange& range) {
  return range.words() + (range.has_commits() ? ": git log " + range.text() : "");
}

bool is_same_range(const CommitRange& a, const CommitRange& b) {
  return a.before.number == b.before.number && a.since.number == b.since.number;
}

/// The range in which most of the groups began; null if no two began in one.
const CommitRange* shared_range(std::span<const FindingGroup* const> groups) {
  const CommitRange* shared = nullptr;
  std::ptrdiff_t most = 1;
  for (const FindingGroup* group : groups) {
    const auto count = std::ranges::count_if(groups, [&](const FindingGroup* other) {
      return is_same_range(group->commits, other->commits);
    });
    if (count <= most) continue;
    most = count;
    shared = &group->commits;
  }
  return shared;
}

/// What, by how much, and since when.
/// @param all     New findings in all.
/// @param shared  The range that is said elsewhere; may be null.
std::string sentence_of(const FindingGroup& group, std::size_t all, const CommitRange* shared) {
  std::string text = group.setup.empty() ? "" : group.setup + ", ";
  text += group.headline();
  if (const std::string values = group.values_text(); !values.empty()) text += " (" + values + ")";
  // The words on all settings have the number of findings.
  const bool is_counted = group.has_all_settings() && group.numbers.size() == group.settings.size();
  const std::string count = group.known  ? group.count_text()
                            : is_counted ? ""
                                         : share_words(group.numbers.size(), all);
  if (!count.empty()) text += " (" + count + ")";
  if (shared == nullptr || !is_same_range(group.commits, *shared))
    text += ", " + range_words(group.commits);
  return text + (group.known ? "; known: " + group.known->text : ".");
}

/// The groups of a study.
std::vector<const FindingGroup*> groups_of(std::span<const FindingGroup> groups,
                                           const std::string& study) {
  std::vector<const FindingGroup*> of_study;
  for (const FindingGroup& group : groups)
    if (group.study == study) of_study.push_back(&group);
  return of_study;
}

/// Between which nightly runs the groups got worse whose sentences do not say it.
/// @param shown   The groups that have a sentence.
/// @param others  Those that are only counted.
std::string shared_words(std::span<const FindingGroup* const> shown,
                         std::span<const FindingGroup* const> others, const CommitRange& shared) {
  const auto is_of_range = [&](const FindingGroup* group) {
    return is_same_range(group->commits, shared);
  };
  const bool are_others = std::ranges::all_of(others, is_of_range);
  std::string which;
  if (std::ranges::all_of(shown, is_of_range))
    which = are_others          ? "All of these"
            : shown.size() == 1 ? "This"
                                : fmt::format("These {}", shown.size());
  else
    which = are_others ? "The others" : "The others named here";
  return fmt::format("{} got worse {}.", which, range_words(shared));
}

/// Adds the first groups of each study; a single group beyond kMostReported has its own sentence,
/// since the one that counts it would be as long.
/// @param names_study  Whether each sentence begins with the study.
void add_findings(std::span<const FindingGroup> groups, std::span<const std::string> studies,
                  bool names_study, NightlyLinks& links, Standing& standing) {
  const std::size_t all = count_findings(groups, false);
  std::vector<const FindingGroup*> shown, others;
  for (const std::string& study : studies) {
    const std::vector<const FindingGroup*> of_study = groups_of(groups, study);
    const std::size_t most = of_study.size() == kMostReported + 1 ? of_study.size() : kMostReported;
    std::size_t more = 0;
    for (std::size_t i = 0; i < of_study.size(); ++i) {
      (i < most ? shown : others).push_back(of_study[i]);
      if (i >= most) more += of_study[i]->numbers.size();
    }
    if (more > 0)
      standing.rest.push_back(
          {{phrase(fmt::format("{} {}, among ", names_study ? study + ": and" : "And",
                               counted(static_cast<long long>(more), "more finding"))),
            links.findings(study), phrase(".")}});
  }
  const CommitRange* shared = shared_range(shown);
  for (const FindingGroup* group : shown)
    standing.sentences.push_back((names_study ? group->study + ": " : "") +
                                 sentence_of(*group, all, shared));
  if (shared != nullptr) standing.note = shared_words(shown, others, *shared);
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
                        const std::string& study, bool is_compared, NightlyLinks& links) {
  Standing result;
  std::vector<FindingGroup> of_study;
  std::ranges::copy_if(groups, std::back_inserter(of_study),
                       [&](const FindingGroup& group) { return group.study == study; });
  add_findings(of_study, std::span(&study, 1), false, links, result);
  result.worse = count_findings(of_study, false) > 0;
  NightlyFacts facts = nightly_run;
  if (!is_compared) facts.reference.reset();
  result.title = verdict_title(facts, of_study);
  return result;
}

Standing nightly_standing(const NightlySummary& summary, NightlyLinks& links) {
  Standing result;
  add_findings(summary.groups, studies_of(summary.groups), true, links, result);
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

bool has_column(const Table& table, const std::string& title) {
  return std::ranges::find(table.columns, title, &Column::title) != table.columns.end();
}

/// Whether a table shows a setting's levels: in a cell of the row, as the title of a column, or in
/// its caption.
bool shows_levels(const Table& table, const std::vector<std::string>& row,
                  const FindingSetting& setting) {
  return !setting.levels.empty() && std::ranges::all_of(setting.levels, [&](const auto& level) {
    return holds(row, level.value) || has_word(table.caption, level.value) ||
           has_column(table, level.value);
  });
}

/// Whether a row is about the method with one of its settings: "ISOMAP, K = 6", "ISOMAP" and
/// "K = 6", or "MCL" in a table of the levels.
bool names_method(const Table& table, const Row& row, const FindingGroup& group) {
  const std::vector<std::string> texts = texts_of(row);
  const auto is_there = [&](const std::string& text) { return holds(texts, text); };
  if (std::ranges::any_of(group.lines, is_there)) return true;
  return is_there(group.method) && std::ranges::any_of(group.settings, [&](const auto& setting) {
           return is_there(setting.shown) || shows_levels(table, texts, setting);
         });
}

/// Whether the table's columns are levels, of which a row has several.
bool has_level_columns(const Table& table, const FindingGroup& group) {
  return std::ranges::any_of(group.settings, [&](const FindingSetting& setting) {
    return std::ranges::any_of(setting.levels,
                               [&](const auto& level) { return has_column(table, level.value); });
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
  const auto has = [&](const std::string& text) {
    return text.find(quantity) != std::string::npos;
  };
  return has(table.caption) || std::ranges::any_of(table.columns, [&](const Column& column) {
           return has(column.title) || has(column.group) || has(column.tooltip);
         });
}

void mark_table(Table& table, const FindingGroup& group) {
  if (!shows_quantity(table, group.quantity)) return;
  for (Row& row : table.rows) {
    if (!names_method(table, row, group) || !is_of_setup(table, row, group.setup)) continue;
    add(row.regressed,
        has_level_columns(table, group) ? group.change_of_settings() : group.change_text());
    table.secondary = false;
  }
}

/// Whether an axis is that of a parameter or factor: "K", "noise [m]", "laser noise [m]" of noise.
bool is_axis_of(const Axis& axis, const std::string& name) {
  const std::string of = axis.label.substr(0, axis.label.find(" ["));
  return of == name || of.ends_with(" " + name);
}

/// Where the settings are on a curve over one of their parameters, in a panel that shows the values
/// of all others; empty if they are not on it.
std::vector<double> points_of(const std::vector<FindingSetting>& settings, const Figure& figure,
                              const Panel& panel) {
  std::vector<double> points;
  for (const FindingSetting& setting : settings) {
    std::vector<ShownLevel> all = setting.levels;
    if (setting.parameter) all.push_back(*setting.parameter);
    std::optional<double> x;
    bool shows_others = true;
    for (const ShownLevel& level : all) {
      if (is_axis_of(panel.x, level.name))
        x = level.number;
      else
        shows_others = shows_others &&
                       (has_word(panel.title, level.value) || has_word(figure.title, level.value));
    }
    if (x && shows_others) points.push_back(*x);
  }
  return points;
}

/// Whether a text begins with what it is about: "Bearing: MPE", "Bearing, K = 6", "bearing/lpca".
bool begins_with(const std::string& text, const std::string& name) {
  const std::string all = lower_case(text), begin = lower_case(name);
  return all.starts_with(begin) &&
         (all.size() == begin.size() ||
          std::string_view(":,/").find(all[begin.size()]) != std::string_view::npos);
}

/// Of each panel, whether it is about something: those that name it, or all panels of a figure that
/// names it where no panel does.
template <typename Names>
std::vector<bool> panels_about(const Figure& figure, bool figure_names, const Names& names) {
  std::vector<bool> about;
  for (const Panel& panel : figure.panels) about.push_back(names(panel));
  if (std::ranges::find(about, true) == about.end()) about.assign(about.size(), figure_names);
  return about;
}

std::vector<bool> panels_of_setup(const Figure& figure, const std::string& setup) {
  const bool figure_names = setup.empty() || begins_with(figure.title, setup) ||
                            std::ranges::any_of(figure.record_ids, [&](const std::string& record) {
                              return begins_with(record, setup);
                            });
  return panels_about(figure, figure_names, [&](const Panel& panel) {
    return !setup.empty() && begins_with(panel.title, setup);
  });
}

std::vector<bool> panels_of_quantity(const Figure& figure, const std::string& quantity) {
  const auto has = [&](const std::string& text) {
    return text.find(quantity) != std::string::npos;
  };
  return panels_about(figure, has(figure.title),
                      [&](const Panel& panel) { return has(panel.y.label); });
}

/// The curves of a figure that got worse: those of the settings, or that of the method over them.
std::vector<RegressedCurve> curves_of(const Figure& figure, const FindingGroup& group) {
  const std::vector<bool> of_setup = panels_of_setup(figure, group.setup),
                          of_quantity = panels_of_quantity(figure, group.quantity);
  std::vector<RegressedCurve> curves;
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    if (!of_setup[i] || !of_quantity[i]) continue;
    for (const Layer& layer : figure.panels[i].layers) {
      RegressedCurve curve{.label = label_of(layer), .panel = i};
      const bool is_of_setting = holds(group.lines, curve.label);
      if (curve.label.empty() || (!is_of_setting && curve.label != group.method)) continue;
      if (!is_of_setting) curve.at = points_of(group.settings, figure, figure.panels[i]);
      const bool is_elsewhere = !is_of_setting && !group.settings.empty() && curve.at.empty();
      if (!is_elsewhere && std::ranges::find(curves, curve) == curves.end())
        curves.push_back(std::move(curve));
    }
  }
  return curves;
}

void mark_figure(FigureBlock& block, std::span<const Figure> figures, const FindingGroup& group) {
  const auto figure = std::ranges::find(figures, block.id, &Figure::id);
  if (figure == figures.end()) return;
  const std::vector<RegressedCurve> curves = curves_of(*figure, group);
  if (curves.empty()) return;
  add(block.regressed, group.headline());
  for (const RegressedCurve& curve : curves)
    if (std::ranges::find(block.regressed_curves, curve) == block.regressed_curves.end())
      block.regressed_curves.push_back(curve);
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
