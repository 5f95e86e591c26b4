#include "reports/sections/trials/trial_tables.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "core/model/status.hpp"
#include "render/figures/status_words.hpp"
#include "reports/sections/cells.hpp"

namespace mapproof {
namespace {

/// A series whose cells are one row of a table.
struct SeriesCells {
  const TrialSeries* series;
  std::vector<const TrialCell*> cells;
};

/// Those series of a setup that were tried.
std::vector<SeriesCells> rows_of(const TrialStudy& study, const TrialSetup& setup,
                                 const std::vector<TrialCell>& cells) {
  std::vector<SeriesCells> rows;
  for (const TrialSeries& series : study.design.series) {
    std::vector<const TrialCell*> found = cells_of(cells, setup.id, series.id);
    if (!found.empty()) rows.push_back({&series, std::move(found)});
  }
  return rows;
}

const TrialCell* cell_at(const SeriesCells& row, double level, const std::string& part) {
  const auto found = std::ranges::find_if(
      row.cells, [&](const TrialCell* cell) { return cell->level == level && cell->part == part; });
  return found == row.cells.end() ? nullptr : *found;
}

/// "SDE: not_converged in 3 of 9 at 0.5.", a sentence a series and status.
void add_notes(const std::vector<SeriesCells>& rows, bool has_levels, Table& table) {
  for (const SeriesCells& row : rows) {
    std::map<StatusCode, std::string> places;
    for (const TrialCell* cell : row.cells)
      for (const auto& [code, count] : cell->statuses) {
        std::string where = cell->part.empty() ? fmt::format("in {} of {}", count, cell->tried)
                                               : "on " + cell->part;
        if (has_levels) where += fmt::format(" at {:.6g}", cell->level);
        places[code] += (places[code].empty() ? "" : ", ") + where;
      }
    for (const auto& [code, where] : places)
      table.notes.push_back(fmt::format("{}: {} {}.", row.series->label, status_words({code, ""}), where));
  }
}

Table simulated_table(const TrialStudy& study, const TrialSetup& setup, std::size_t quantity,
                      const std::vector<TrialCell>& cells) {
  const Quantity& what = study.design.quantities[quantity];
  const std::vector<SeriesCells> rows = rows_of(study, setup, cells);
  const int decimals = decimals_of(cells, quantity);
  Table table;
  table.id = fmt::format("{}-{}-{}", id_prefix(study), setup.id, what.id);
  std::ranges::replace(table.id, '_', '-');
  table.caption = fmt::format("{}: {}", setup.title, label_with_unit(what));
  if (!setup.level_label.empty()) table.caption += ", by " + setup.level_label;
  table.columns.push_back({"Series", "", "", ""});
  for (const double level : setup.levels) {
    const bool has_levels = !setup.level_label.empty();
    const std::string title = has_levels ? fmt::format("{:.6g}", level) : what.label;
    table.columns.push_back({title, "", has_levels ? setup.level_label : "", ""});
    table.columns.push_back({"95 %", "", has_levels ? setup.level_label : "",
                             "Interval of the mean over layouts, by Student's t."});
  }
  for (const SeriesCells& row : rows) {
    Row line{{TextCell{row.series->label}}, "", false};
    for (const double level : setup.levels) {
      const TrialCell* cell = cell_at(row, level, "");
      const auto mean = cell == nullptr ? std::nullopt : cell->means[quantity];
      line.cells.push_back(mean_cell(mean, decimals));
      line.cells.push_back(difference_interval_cell(mean, decimals));
    }
    table.rows.push_back(std::move(line));
  }
  const auto runs = static_cast<int>(study.parts.size());
  table.notes.push_back(
      fmt::format("Mean over {} and its 95 % interval, where a layout is one independent unit.",
                  runs == 1 ? std::string("1 run") : fmt::format("{} runs", runs)));
  for (const SeriesCells& row : rows)
    for (const TrialCell* cell : row.cells)
      if (const int scored = cell->means[quantity] ? cell->means[quantity]->values : 0;
          scored < cell->tried)
        table.notes.push_back(fmt::format("{} at {:.6g}: {} of {} runs gave a value.",
                                          row.series->label, cell->level, scored, cell->tried));
  add_notes(rows, !setup.level_label.empty(), table);
  return table;
}

std::string title_of(const TrialStudy& study, const std::string& part) {
  const auto set = std::ranges::find(study.experiment.data, part, &TrialDataSet::id);
  return set == study.experiment.data.end() ? part : set->title;
}

/// Of one data set: all quantities of several sets side by side would be too wide to read.
Table data_table(const TrialStudy& study, const TrialSetup& setup, const TrialPart& part,
                 const std::vector<TrialCell>& cells) {
  Table table;
  table.id = fmt::format("{}-{}-{}", id_prefix(study), setup.id, part.id);
  table.caption = fmt::format("{}: {}", title_of(study, part.id), setup.title);
  const bool has_levels = !setup.level_label.empty();
  table.columns.push_back({"Series", "", "", ""});
  if (has_levels) table.columns.push_back({setup.level_label, "", "", ""});
  for (const Quantity& quantity : study.design.quantities)
    table.columns.push_back({quantity.label, quantity.unit, "", ""});
  const std::vector<SeriesCells> rows = rows_of(study, setup, cells);
  for (const SeriesCells& row : rows)
    for (const double level : setup.levels) {
      Row line{{TextCell{row.series->label}}, "", false};
      if (has_levels) line.cells.emplace_back(TextCell{fmt::format("{:.6g}", level)});
      const TrialCell* cell = cell_at(row, level, part.id);
      for (std::size_t i = 0; i < study.design.quantities.size(); ++i)
        line.cells.push_back(cell == nullptr ? Cell(MissingCell{})
                                             : mean_cell(cell->means[i], decimals_of(cells, i)));
      table.rows.push_back(std::move(line));
    }
  add_notes(rows, has_levels, table);
  return table;
}

/// Cells of one setup alone, so that decimals suit its numbers.
std::vector<TrialCell> cells_in(const TrialStudy& study, const TrialSetup& setup) {
  std::vector<TrialCell> cells = trial_cells(study);
  std::erase_if(cells, [&](const TrialCell& cell) { return cell.setup != setup.id; });
  return cells;
}

}  // namespace

std::vector<Table> trial_tables(const TrialStudy& study, const TrialSetup& setup) {
  const std::vector<TrialCell> cells = cells_in(study, setup);
  if (cells.empty()) return {};
  std::vector<Table> tables;
  if (is_of_data(study)) {
    for (const TrialPart& part : study.parts) {
      std::vector<TrialCell> own = cells;
      std::erase_if(own, [&](const TrialCell& cell) { return cell.part != part.id; });
      if (!own.empty()) tables.push_back(data_table(study, setup, part, own));
    }
    return tables;
  }
  for (std::size_t i = 0; i < study.design.quantities.size(); ++i)
    if (std::ranges::any_of(cells, [&](const TrialCell& c) { return c.means[i].has_value(); }))
      tables.push_back(simulated_table(study, setup, i, cells));
  return tables;
}

std::vector<Table> trial_seconds_tables(const TrialStudy& study) {
  if (!is_of_data(study)) return {};
  Table table;
  table.id = id_prefix(study) + "-seconds";
  table.caption = "What it took";
  table.columns.push_back({"Series", "", "", ""});
  for (const TrialPart& part : study.parts)
    table.columns.push_back({title_of(study, part.id), "s", "", ""});
  for (const TrialSeries& series : study.design.series) {
    Row line{{TextCell{series.label}}, "", false};
    bool any = false;
    for (const TrialPart& part : study.parts) {
      const auto timing = std::ranges::find(part.seconds, series.id, &TrialSeconds::series);
      any |= timing != part.seconds.end();
      line.cells.push_back(timing == part.seconds.end() ? Cell(MissingCell{})
                                                        : NumberCell{timing->seconds, 3});
    }
    if (any) table.rows.push_back(std::move(line));
  }
  table.notes.emplace_back(
      "Seconds of making the map; reading the files is not part of them. They differ from one run "
      "of "
      "the program to the next; what the whole run took is under Provenance.");
  if (table.rows.empty()) return {};
  return {std::move(table)};
}

}  // namespace mapproof
