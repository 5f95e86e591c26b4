#include "reports/model/report.hpp"

#include <algorithm>
#include <set>

#include "core/base/errors.hpp"
#include "core/base/text/slug.hpp"

namespace mapproof {
namespace {

bool is_id(const std::string& id) {
  return !id.empty() && id.size() <= kLongestId && std::ranges::all_of(id, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-';
  });
}

class IdCheck {
 public:
  void add(const std::string& id) {
    if (!is_id(id)) throw InvalidInput("report: \"" + printable(id) + "\" is not an id");
    if (!seen_.insert(id).second) throw InvalidInput("report: the id \"" + id + "\" stands twice");
  }

  bool has(const std::string& id) const { return seen_.contains(id); }

 private:
  std::set<std::string> seen_;
};

void check_rows(const Table& table) {
  for (const Row& row : table.rows)
    if (row.cells.size() != table.columns.size())
      throw InvalidInput("report: a row of table \"" + table.id + "\" lacks cells");
}

}  // namespace

void check(const Report& report) {
  IdCheck section_ids;
  for (const Section& section : report.sections) section_ids.add(section.id);
  IdCheck table_ids;
  for (const Table* table : tables(report)) {
    table_ids.add(table->id);
    check_rows(*table);
  }
  IdCheck figure_ids;
  for (const FigureBlock* figure : figures(report)) figure_ids.add(figure->id);
  const auto require_figure = [&](const std::string& id) {
    if (!figure_ids.has(id)) throw InvalidInput("report: there is no figure \"" + id + "\"");
  };
  for (const std::string& id : report.opening.figure_ids) require_figure(id);
  if (!report.opening.main_figure.empty()) require_figure(report.opening.main_figure);
  for (const Highlights::Item& number : report.opening.numbers.items) {
    if (!number.section.empty() && !section_ids.has(number.section))
      throw InvalidInput("report: there is no section \"" + printable(number.section) + "\"");
    if (!number.table.empty() && !table_ids.has(number.table))
      throw InvalidInput("report: there is no table \"" + printable(number.table) + "\"");
  }
}

bool holds_text(const Table& table, std::size_t column) {
  if (table.rows.empty()) return true;
  return std::ranges::any_of(table.rows, [&](const Row& row) {
    return std::holds_alternative<TextCell>(row.cells[column]);
  });
}

bool holds_intervals(const Table& table, std::size_t column) {
  return std::ranges::any_of(table.rows, [&](const Row& row) {
    return std::holds_alternative<IntervalCell>(row.cells[column]);
  });
}

bool is_regressed(const Table& table) { return regressed_rows(table) > 0; }

std::ptrdiff_t regressed_rows(const Table& table) {
  return std::ranges::count_if(table.rows, [](const Row& row) { return !row.regressed.empty(); });
}

std::size_t regressed_figures(const Gallery& gallery) {
  for (std::size_t i = gallery.figures.size(); i > 0; --i)
    if (!gallery.figures[i - 1].regressed.empty()) return i;
  return 0;
}

bool shows_regression(const Section& section) {
  return std::ranges::any_of(section.blocks, [](const Block& block) {
    const auto* table = std::get_if<Table>(&block);
    const auto* figure = std::get_if<FigureBlock>(&block);
    const auto* gallery = std::get_if<Gallery>(&block);
    return (table != nullptr && is_regressed(*table)) ||
           (figure != nullptr && !figure->regressed.empty()) ||
           (gallery != nullptr && regressed_figures(*gallery) > 0);
  });
}

std::vector<const Table*> tables(const Report& report) {
  std::vector<const Table*> found;
  for (const Section& section : report.sections)
    for (const Block& block : section.blocks)
      if (const auto* table = std::get_if<Table>(&block)) found.push_back(table);
  return found;
}

std::vector<const FigureBlock*> figures(const Report& report) {
  std::vector<const FigureBlock*> found;
  for (const Section& section : report.sections)
    for (const Block& block : section.blocks) {
      if (const auto* figure = std::get_if<FigureBlock>(&block)) found.push_back(figure);
      if (const auto* gallery = std::get_if<Gallery>(&block))
        for (const FigureBlock& figure : gallery->figures) found.push_back(&figure);
    }
  return found;
}

}  // namespace mapproof
