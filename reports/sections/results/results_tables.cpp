#include "reports/sections/results/results_tables.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/results/results_conventions.hpp"
#include "reports/sections/results/results_figures.hpp"
#include "reports/sections/tables/cells.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr const char* kIntervalHint =
    "95 % interval of the mean, by Student's t over groups; cut where no value can lie.";
constexpr const char* kSpreadHint =
    "Least and greatest of the runs, whose groups are too few for an interval of the mean.";

std::string column_title(const Level& level) {
  const auto* number = std::get_if<double>(&level.value);
  return number == nullptr ? level_text(level) : level_number_text(*number);
}

Cell interval_cell_of(const std::optional<Interval>& interval, int decimals) {
  if (!interval) return MissingCell{};
  return IntervalCell{interval->low, interval->high, decimals};
}

/// Whether means are over several runs, which repeat each other.
bool has_repeats(const ResultsView& view) {
  return view.study().results.are_repeats && view.runs() > 1;
}

/// As listed(), all of them, parted by semicolons where a name has a comma.
std::string all_of(const std::vector<std::string>& names) {
  const bool have_commas = std::ranges::any_of(
      names, [](const std::string& name) { return name.find(", ") != std::string::npos; });
  return have_commas ? fmt::format("{}", fmt::join(names, "; ")) : listed(names, names.size() + 1);
}

/// What is said of lines of a table, in the order in which it is first said.
class LineNotes {
 public:
  void add(const std::string& label, const std::string& words) {
    auto note = std::ranges::find(notes_, words, &Note::words);
    if (note == notes_.end()) note = notes_.insert(note, {words, {}});
    note->labels.push_back(label);
  }

  /// Of the same words one note: "Isomap and SDE: failed."
  void append_to(Table& table) const {
    for (const auto& [words, labels] : notes_)
      table.notes.push_back(fmt::format("{}: {}.", all_of(labels), words));
  }

 private:
  struct Note {
    std::string words;
    std::vector<std::string> labels;
  };
  std::vector<Note> notes_;
};

/// Values lost by the lines of a table: of each line by their number, where.
class LostValues {
 public:
  /// @param where  May be empty.
  void add(const std::string& label, int lost, const std::string& where) {
    if (losses_.empty() || losses_.back().label != label) losses_.push_back({label, {}});
    losses_.back().places[lost].push_back(where);
  }

  /// "Isomap and SDE: 1 value lost each (MPE and MOE)."
  void append_to(Table& table) const {
    LineNotes notes;
    for (const auto& [label, places] : losses_)
      for (auto [lost, where] : places) {
        std::erase(where, "");
        notes.add(label, fmt::format("{} lost{}{}", counted(lost, "value"),
                                     where.size() > 1 ? " each" : "",
                                     where.empty() ? "" : fmt::format(" ({})", all_of(where))));
      }
    notes.append_to(table);
  }

 private:
  struct Losses {
    std::string label;
    std::map<int, std::vector<std::string>> places;
  };
  std::vector<Losses> losses_;
};

/// The cells of one condition, and the notes on them.
class CellMaker {
 public:
  CellMaker(const ResultsView& view, Table& table) : view_(view), table_(table) {}

  /// @param where  The condition or quantity, for the notes.
  void add(Row& row, const Condition& at, const ResultsLine& line, const Quantity& quantity,
           const std::string& where) {
    const int decimals = view_.decimals(quantity);
    const auto mean = view_.mean(at, line, quantity);
    row.cells.push_back(mean_cell(mean, decimals));
    if (has_repeats(view_))
      row.cells.push_back(interval_cell_of(view_.spread(at, line, quantity), decimals));
    if (const int lost = view_.numbers(at, line, quantity).lost; lost > 0)
      lost_.add(line.label, lost, where);
  }

  /// After the last cell.
  void add_notes() { lost_.append_to(table_); }

  /// @param title  Of the column; empty: the quantity and its unit.
  void add_column(const Quantity& quantity, const std::string& title = "",
                  const std::string& group = "") {
    const std::string unit = title.empty() ? quantity.unit : "";
    const bool errors_m = view_.has_great_errors(quantity);
    table_.columns.push_back({title.empty() ? quantity.label : title, unit, group, "", errors_m});
    if (!has_repeats(view_)) return;
    if (view_.has_groups_for_intervals())
      table_.columns.push_back({"95 %", unit, group, kIntervalHint, errors_m});
    else
      table_.columns.push_back({"runs", unit, group, kSpreadHint, errors_m});
  }

 private:
  const ResultsView& view_;
  Table& table_;
  LostValues lost_;
};

void add_note(const ResultsView& view, const std::string& setup, Table& table) {
  if (!has_repeats(view)) return;
  const RunCounts counts = view.counts_of(setup);
  table.notes.insert(
      table.notes.begin(),
      fmt::format("Mean over runs and {}; {} in {}, a group is one independent unit.",
                  view.has_groups_for_intervals()
                      ? "its 95 % interval"
                      : "their least and greatest value, since groups are too few for an interval",
                  counted(static_cast<long long>(counts.runs), "run"),
                  counted(static_cast<long long>(counts.groups), "group")));
}

/// "SDE: not converged in 3 of 9 at noise 0.5.": lines of which the same is said are in one note.
void add_status_notes(const ResultsView& view, const ResultsBlock& block,
                      const std::vector<ResultsLine>& lines, Table& table) {
  LineNotes notes;
  for (const ResultsLine& line : lines) {
    std::map<std::string, std::vector<std::string>> places;  // By code.
    for (std::size_t i = 0; i < block.conditions.size(); ++i) {
      const StatusCounts counts = view.statuses(block.conditions[i], line);
      for (const auto& [code, count] : counts.codes) {
        std::string place =
            counts.runs == 1 ? std::string() : fmt::format("in {} of {}", count, counts.runs);
        if (!block.factor.empty())
          place += (place.empty() ? "at " : " at ") + view.level_words(block.levels[i]);
        places[code].push_back(std::move(place));
      }
    }
    for (auto& [code, where] : places) {
      std::erase(where, "");
      notes.add(line.label, fmt::format("{}{}{}", code_words(code), where.empty() ? "" : " ",
                                        listed(where, where.size() + 1)));
    }
  }
  notes.append_to(table);
}

/// Whether any quantity of the study has a result, or a lost one.
bool is_tried(const ResultsView& view, const Condition& at, const ResultsLine& line) {
  return std::ranges::any_of(view.study().quantities, [&](const std::string& id) {
    const RunNumbers numbers = view.numbers(at, line, view.quantity(id));
    return !numbers.values.empty() || numbers.lost > 0;
  });
}

/// "Landmark MVU: not tried at landmarks 500.": why cells are empty of which nothing was lost.
/// @param places  The conditions in words.
void add_notes_of_not_tried(const ResultsView& view, const std::vector<Condition>& conditions,
                            const std::vector<std::string>& places,
                            const std::vector<ResultsLine>& lines, Table& table) {
  LineNotes notes;
  for (const ResultsLine& line : lines) {
    std::vector<std::string> without;
    for (std::size_t i = 0; i < conditions.size(); ++i)
      if (!is_tried(view, conditions[i], line)) without.push_back(places[i]);
    if (!without.empty()) notes.add(line.label, "not tried at " + all_of(without));
  }
  notes.append_to(table);
}

/// One quantity over the levels.
Table level_table(const ResultsView& view, const ResultsBlock& block, const Quantity& quantity) {
  Table table;
  table.id = id_below(block.id, quantity.id);
  table.caption = fmt::format("{}: {}, by {}", block.title, label_with_unit(quantity),
                              view.factor_label(block.factor));
  table.columns.push_back({"Method", "", "", ""});
  CellMaker cells(view, table);
  for (const Level& level : block.levels) {
    const std::size_t index = table.columns.size();
    cells.add_column(quantity, column_title(level), view.factor_label(block.factor));
    if (const auto* number = std::get_if<double>(&level.value))
      table.columns[index].number = *number;
  }
  const std::vector<ResultsLine> lines = view.lines(block, quantity);
  for (const ResultsLine& line : lines) {
    Row row{{TextCell{line.label, Emphasis::kData}}, "", false};
    for (std::size_t i = 0; i < block.levels.size(); ++i)
      cells.add(row, block.conditions[i], line, quantity, view.level_words(block.levels[i]));
    table.rows.push_back(std::move(row));
  }
  cells.add_notes();
  std::vector<std::string> places;
  for (const Level& level : block.levels) places.push_back(view.level_words(level));
  add_notes_of_not_tried(view, block.conditions, places, lines, table);
  add_note(view, block.conditions.front().setup, table);
  add_status_notes(view, block, lines, table);
  return table;
}

/// Lines, each once, in the order of methods. Methods may have the same label, lines of a table not
/// the same method and run.
class DistinctLines {
 public:
  void add(const std::vector<ResultsLine>& lines) {
    for (const ResultsLine& line : lines)
      if (known_.emplace(line.method, line.run).second) lines_.push_back(line);
  }
  std::vector<ResultsLine> take() {
    std::ranges::stable_sort(lines_, {}, &ResultsLine::index);
    return std::move(lines_);
  }

 private:
  std::set<std::pair<std::string, std::string>> known_;
  std::vector<ResultsLine> lines_;
};

/// The lines that any of a block's quantities has, in the order of methods.
std::vector<ResultsLine> all_lines(const ResultsView& view, const ResultsBlock& block) {
  DistinctLines lines;
  for (const Quantity* quantity : view.quantities(block)) lines.add(view.lines(block, *quantity));
  return lines.take();
}

/// All quantities of a block with one level.
Table single_table(const ResultsView& view, const ResultsBlock& block) {
  Table table;
  table.id = id_below(block.id, "means");
  table.caption = block.title;
  table.columns.push_back({"Method", "", "", ""});
  CellMaker cells(view, table);
  const std::vector<const Quantity*> quantities = view.quantities(block);
  const std::vector<ResultsLine> lines = all_lines(view, block);
  for (const Quantity* quantity : quantities) cells.add_column(*quantity);
  for (const ResultsLine& line : lines) {
    Row row{{TextCell{line.label, Emphasis::kData}}, "", false};
    for (const Quantity* quantity : quantities)
      cells.add(row, block.conditions.front(), line, *quantity, quantity->label);
    table.rows.push_back(std::move(row));
  }
  cells.add_notes();
  add_note(view, block.conditions.front().setup, table);
  add_status_notes(view, block, lines, table);
  return table;
}

/// All quantities of one run that is not a repeat of the others; empty if the block has none of it.
std::optional<Table> run_table(const ResultsView& view, const ResultsBlock& block,
                               const Label& run) {
  std::vector<ResultsLine> lines = all_lines(view, block);
  std::erase_if(lines, [&](const ResultsLine& line) { return line.run != run.id; });
  if (lines.empty()) return std::nullopt;
  Table table;
  table.id = id_below(block.id, run.id);
  table.caption = run.label + ": " + block.title;
  table.columns.push_back({"Method", "", "", ""});
  if (!block.factor.empty()) table.columns.push_back({view.factor_label(block.factor), "", "", ""});
  const std::vector<const Quantity*> quantities = view.quantities(block);
  CellMaker cells(view, table);
  for (const Quantity* quantity : quantities) cells.add_column(*quantity);
  for (ResultsLine& line : lines) {
    line.label = view.study().methods[line.index].label;  // The caption names the run.
    for (std::size_t level = 0; level < block.conditions.size(); ++level) {
      Row row{{TextCell{line.label, Emphasis::kData}}, "", false};
      if (!block.factor.empty())
        row.cells.emplace_back(TextCell{column_title(block.levels[level])});
      for (const Quantity* quantity : quantities)
        cells.add(row, block.conditions[level], line, *quantity, quantity->label);
      table.rows.push_back(std::move(row));
    }
  }
  cells.add_notes();
  add_status_notes(view, block, lines, table);
  return table;
}

}  // namespace

namespace {

/// Whether a table has one number in every cell but its labels.
bool has_one_number(const Table& table) {
  std::set<double> numbers;
  for (const Row& row : table.rows)
    for (std::size_t i = 1; i < row.cells.size(); ++i) {
      if (const auto* number = std::get_if<NumberCell>(&row.cells[i]))
        numbers.insert(number->value);
      else if (const auto* interval = std::get_if<IntervalCell>(&row.cells[i]))
        numbers.insert({interval->low, interval->high});
      else
        return false;
    }
  return numbers.size() == 1;
}

}  // namespace

std::vector<Table> results_tables(const ResultsView& view, const ResultsBlock& block) {
  if (!view.study().runs.empty()) {
    std::vector<Table> of_runs;
    for (const Label& run : view.study().runs)
      if (auto table = run_table(view, block, run)) of_runs.push_back(*std::move(table));
    return of_runs;
  }
  if (block.factor.empty()) return {single_table(view, block)};
  std::vector<Table> tables;
  // A sentence says what is one number, in place of a figure; the notes are those of the others.
  std::vector<Table> said;
  for (const Quantity* quantity : view.quantities(block)) {
    Table table = level_table(view, block, *quantity);
    const bool is_said = has_one_number(table) && !why_no_figure(view, block, *quantity).empty();
    (is_said ? said : tables).push_back(std::move(table));
  }
  if (tables.empty()) return said;
  return tables;
}

std::optional<ResultsLine> only_line(const ResultsView& view, const ResultsBlock& block) {
  const std::vector<ResultsLine> lines = all_lines(view, block);
  return lines.size() == 1 ? std::optional(lines.front()) : std::nullopt;
}

Table blocks_table(const ResultsView& view, std::span<const ResultsBlock> blocks,
                   const std::string& title) {
  const ResultsBlock& first = blocks.front();
  Table table;
  table.id = id_below(first.id, "means");
  table.caption = title;
  table.columns.push_back({"Setup", "", "", ""});
  CellMaker cells(view, table);
  for (const Quantity* quantity : view.quantities(first)) cells.add_column(*quantity);
  for (const ResultsBlock& block : blocks) {
    ResultsLine line = *only_line(view, block);
    line.label = block.title;  // Notes name the row.
    Row row{{TextCell{line.label}}, "", false};
    for (const Quantity* quantity : view.quantities(block))
      cells.add(row, block.conditions.front(), line, *quantity, quantity->label);
    table.rows.push_back(std::move(row));
    add_status_notes(view, block, {line}, table);
  }
  cells.add_notes();
  add_note(view, first.conditions.front().setup, table);
  return table;
}

std::vector<Table> overview_tables(const ResultsView& view, const ResultsOverview& overview) {
  std::vector<Table> tables;
  for (const std::string& id : view.study().quantities) {
    const Quantity& quantity = view.quantity(id);
    DistinctLines distinct;
    for (const ResultsBlock* block : overview.blocks) distinct.add(view.lines(*block, quantity));
    const std::vector<ResultsLine> lines = distinct.take();
    if (lines.empty()) continue;
    Table table;
    table.id = id_below(overview.id, id);
    table.caption = fmt::format("{}: {}{}", overview.title, label_with_unit(quantity),
                                overview.level ? ", at " + view.level_words(*overview.level) : "");
    table.columns.push_back({"Method", "", "", ""});
    CellMaker cells(view, table);
    for (const std::string& name : overview.names)
      cells.add_column(quantity, name, overview.factors);
    for (const ResultsLine& line : lines) {
      Row row{{TextCell{line.label, Emphasis::kData}}, "", false};
      for (std::size_t i = 0; i < overview.conditions.size(); ++i)
        cells.add(row, overview.conditions[i], line, quantity, overview.names[i]);
      table.rows.push_back(std::move(row));
    }
    cells.add_notes();
    add_notes_of_not_tried(view, overview.conditions, overview.names, lines, table);
    add_note(view, overview.conditions.front().setup, table);
    tables.push_back(std::move(table));
  }
  return tables;
}

Table comparison_table(const ResultsView& view, const MethodComparison& comparison) {
  const Quantity& quantity = *comparison.quantity;
  const int places = view.decimals(quantity);
  const bool errors_m = view.has_great_errors(quantity);
  Table table;
  table.id = id_below(comparison.id, "paired-" + quantity.id);
  table.caption = fmt::format("{}: {} compared with the best method", where_of(comparison),
                              label_with_unit(quantity));
  table.columns = {{"Method", "", "", ""},
                   {view.runs() > 1 ? "Mean" : quantity.label, quantity.unit, "",
                    "Over the runs that all of these methods have.", errors_m},
                   {"Mean rank", "", "", "1 is best; methods are ranked in each group."},
                   {"Difference", quantity.unit, "",
                    "From the best method: of the same runs, each group counted once.", errors_m},
                   {"95 %", quantity.unit, "", "Interval of the difference.", errors_m},
                   {"p", "", "", "Of no difference, corrected by Holm for the number of methods."}};
  for (std::size_t i = 0; i < comparison.methods.size(); ++i) {
    const ComparedMethod& method = comparison.methods[i];
    Row row{{TextCell{view.study().methods[method.method].label, Emphasis::kData},
             NumberCell{method.mean, places}},
            "",
            i == 0};
    row.cells.push_back(comparison.ranks ? Cell(NumberCell{comparison.ranks->mean_ranks[i], 2})
                                         : Cell(MissingCell{}));
    if (method.change) {
      row.cells.push_back(NumberCell{method.change->shift, places, true});
      // Equal values have no interval.
      row.cells.push_back(method.change->low < method.change->high
                              ? Cell(IntervalCell{method.change->low, method.change->high, places})
                              : Cell(MissingCell{}));
      row.cells.push_back(p_cell(method.corrected_p));
    } else {
      row.cells.insert(row.cells.end(), 3, MissingCell{});
    }
    table.rows.push_back(std::move(row));
  }
  if (comparison.methods.size() > 1 && comparison.methods[1].change)
    table.notes.push_back(fmt::format(
        "Paired over {}: {}.", counted(comparison.groups, "group"),
        comparison.methods[1].change->by_ranks
            ? "Wilcoxon's signed-rank test, and the Hodges-Lehmann estimate of the difference"
            : "Student's t of the differences"));
  drop_empty_columns(table);
  if (!comparison.has_all_runs)
    table.notes.push_back(fmt::format(
        "Over the {} that all of these methods have; the tables above take every run of a method.",
        counted(comparison.runs, "run")));
  if (!comparison.left_out.empty())
    table.notes.push_back("Left out, without a value in some group or in half of the runs: " +
                          listed(comparison.left_out, comparison.left_out.size() + 1) + ".");
  if (std::string note = disagreement_of(comparison, view); !note.empty())
    table.notes.push_back(std::move(note));
  return table;
}

}  // namespace mapproof
