#include "core/records/studies/results_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/csv.hpp"
#include "core/base/text/spelling.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestCell = 1000;
constexpr std::string_view kAt = "at.";

/// A column of text, and what it is of a result.
struct TextColumn {
  std::string_view name;
  std::string Result::*text;
  bool needed;
};
constexpr std::array kTextColumns = {
    TextColumn{"method", &Result::method, true}, TextColumn{"quantity", &Result::quantity, true},
    TextColumn{"run", &Result::run, false}, TextColumn{"group", &Result::group, false},
    TextColumn{"subject", &Result::subject, false}};
constexpr std::string_view kSetup = "setup";
constexpr std::string_view kValue = "value";
constexpr double kGreatestLevel = 1e100;  // An axis cannot show more.

std::string value_text(double value) {
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  return csv_number(value);
}

std::string line_name(std::size_t line) { return fmt::format("line {}", line); }

/// Reads the rows that follow a header.
class ResultsReader {
 public:
  ResultsReader(std::string_view text, const std::string& source, const Quantities& quantities)
      : source_(source), quantities_(quantities), table_(text, source, ',') {
    // A row takes some ten times its text: no vector of them may grow by halves.
    const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    rows_.reserve(lines);
    lines_.reserve(lines);
  }

  std::vector<Result> read() {
    if (!table_.next(row_)) throw IoError(source_, "has no header");
    read_header();
    while (table_.next(row_)) {
      if (row_.cells.size() != columns_.size())
        fail(fmt::format("{} cells where the header has {}", row_.cells.size(), columns_.size()));
      rows_.push_back(result_of_row());
      lines_.push_back(static_cast<std::uint32_t>(row_.line));
    }
    check_levels();
    sort_rows();
    check_apart();
    return std::move(rows_);
  }

 private:
  /// Stably, and without a second place for each row.
  void sort_rows() {
    std::vector<std::uint32_t> order(rows_.size());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, [this](std::uint32_t a, std::uint32_t b) {
      return comes_before(rows_[a], rows_[b]);
    });
    // Place i gets row order[i], along each cycle of the permutation.
    for (std::uint32_t start = 0; start < order.size(); ++start)
      for (std::uint32_t to = start; order[to] != to;) {
        const std::uint32_t from = std::exchange(order[to], to);
        if (from == start) break;
        std::swap(rows_[to], rows_[from]);
        std::swap(lines_[to], lines_[from]);
        to = from;
      }
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(source_, line_name(row_.line), what);
  }

  /// Tables that are not separated by commas, and columns that a data frame adds.
  void check_form() const {
    const std::string_view first = row_.cells.front();
    for (const auto& [separator, name] : {std::pair(';', "semicolons"), std::pair('\t', "tabs")})
      if (row_.cells.size() == 1 && first.find(separator) != std::string_view::npos)
        fail(fmt::format("the cells are separated by {}; commas are needed: to_csv(sep=\",\")",
                         name));
    if (first.empty() || first.starts_with("Unnamed:"))
      fail("the first column has no name, as an index has: to_csv(index=False) leaves it out");
  }

  void read_header() {
    check_form();
    std::vector<std::string_view> known = {kSetup, kValue};
    std::vector<std::string_view> needed = known;
    for (const TextColumn& column : kTextColumns) {
      known.push_back(column.name);
      if (column.needed) needed.push_back(column.name);
    }
    std::set<std::string, std::less<>> there;
    for (const std::string_view cell : row_.cells) {
      const bool is_factor = cell.starts_with(kAt) && cell.size() > kAt.size();
      if (!is_factor && std::ranges::find(known, cell) == known.end()) {
        const std::string_view meant = likely_word(cell, known);
        fail(fmt::format(
            "unknown column {}{}", in_quotes(cell),
            meant.empty() ? "; a factor's is at.NAME" : fmt::format("; did you mean {}?", meant)));
      }
      if (!there.emplace(cell).second)
        fail(fmt::format("column {} is there twice", in_quotes(cell)));
      columns_.emplace_back(cell);
    }
    for (const std::string_view column : needed)
      if (!there.contains(column)) fail(fmt::format("the column \"{}\" is missing", column));
    if (there.contains("group") && !there.contains("run"))
      fail("the column \"group\" needs the column \"run\": runs are what a group is of");
  }

  Result result_of_row() {
    Result result;
    for (std::size_t i = 0; i < columns_.size(); ++i) read_cell(columns_[i], row_.cells[i], result);
    result.at = condition(std::move(result.at.setup), std::move(result.at.levels));
    if (result.method.empty()) fail("the method is missing");
    if (quantities_.find(result.quantity) == nullptr) fail(unknown_quantity(result.quantity));
    if (result.group.empty()) result.group = result.run;
    const auto [known, is_new] = groups_.try_emplace(result.run, result.group, row_.line);
    if (!is_new && known->second.first != result.group)
      fail(fmt::format("the run {} is of the group {} here and of {} on line {}",
                       in_quotes(result.run), in_quotes(result.group),
                       in_quotes(known->second.first), known->second.second));
    return result;
  }

  void read_cell(std::string_view column, std::string_view cell, Result& result) const {
    if (cell.size() > kLongestCell)
      fail(fmt::format("a cell of {} bytes; {} are allowed", cell.size(), kLongestCell));
    if (column == kSetup) {
      result.at.setup = cell;
    } else if (column == kValue) {
      result.value = number_of(cell);
    } else if (column.starts_with(kAt)) {
      if (is_missing(cell)) return;
      const std::optional<double> number = number_in(cell);
      if (number && !(std::abs(*number) <= kGreatestLevel))
        fail(fmt::format("{}: {} is beyond 1e100", printable(std::string(column), 40),
                         in_quotes(cell)));
      Level level{.factor = std::string(column.substr(kAt.size())), .value = std::string(cell)};
      if (number) level.value = *number;
      result.at.levels.push_back(std::move(level));
    } else {
      for (const TextColumn& text : kTextColumns)
        if (text.name == column) result.*text.text = cell;
    }
  }

  double number_of(std::string_view cell) const {
    if (is_missing(cell)) return kNaN;
    const std::optional<double> number = number_in(cell);
    if (!number) fail(fmt::format("value: {}", number_problem(cell)));
    return *number;
  }

  std::string unknown_quantity(const std::string& id) const {
    std::vector<std::string_view> known;
    const std::vector<Quantity> all = quantities_.all();
    for (const Quantity& quantity : all) known.push_back(quantity.id);
    const std::string_view meant = likely_word(id, known);
    return fmt::format("there is no quantity {}{}", in_quotes(id),
                       meant.empty() ? "; study.json has to declare it"
                                     : fmt::format("; did you mean {}?", meant));
  }

  /// Throws if a factor has numbers and texts within one setup: it would have no order.
  void check_levels() {
    struct Kind {
      std::size_t rows = 0, line = 0;  ///< How many, and the first.
      std::string cell;
    };
    std::map<std::pair<std::string, std::string>, std::array<Kind, 2>> factors;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (const Level& level : rows_[i].at.levels) {
        Kind& kind = factors[{level.factor, rows_[i].at.setup}][level.value.index()];
        if (kind.rows++ == 0) kind.line = lines_[i], kind.cell = level_text(level);
      }
    for (const auto& [factor, kinds] : factors) {
      const auto& [numbers, texts] = kinds;
      if (numbers.rows == 0 || texts.rows == 0) continue;
      const bool is_text = texts.rows <= numbers.rows;
      const Kind& odd = is_text ? texts : numbers;
      row_.line = odd.line;
      fail(
          fmt::format("at.{}: {} is a {} where {} of the setup have {}; write all levels of a "
                      "factor as numbers or all as texts",
                      printable(factor.first, 40), in_quotes(odd.cell), is_text ? "text" : "number",
                      counted(static_cast<long long>((is_text ? numbers : texts).rows), "row"),
                      is_text ? "numbers" : "texts"));
    }
  }

  /// Throws if two rows are of the same quantity.
  void check_apart() {
    for (std::size_t i = 1; i < rows_.size(); ++i)
      if (!comes_before(rows_[i - 1], rows_[i])) {
        row_.line = lines_[i];
        fail(fmt::format("has the same setup, levels, method, quantity, run and subject as line {}",
                         lines_[i - 1]));
      }
  }

  const std::string& source_;
  const Quantities& quantities_;
  TableReader table_;
  TableRow row_;
  std::vector<std::string> columns_;
  std::vector<Result> rows_;
  std::vector<std::uint32_t> lines_;  ///< Of each row.
  std::map<std::string, std::pair<std::string, std::size_t>> groups_;  ///< By run.
};

}  // namespace

std::string results_csv(const std::vector<Result>& rows) {
  std::set<std::string> factors;
  for (const Result& row : rows)
    for (const Level& level : row.at.levels) factors.insert(level.factor);
  std::string text = "setup,method,quantity,run,group,subject,value";
  for (const std::string& factor : factors) text += "," + csv_field(std::string(kAt) + factor);
  text += "\r\n";
  for (const Result& row : rows) {
    text += csv_field(row.at.setup);
    for (const TextColumn& column : kTextColumns) text += "," + csv_field(row.*column.text);
    text += "," + value_text(row.value);
    for (const std::string& factor : factors) {
      const auto level = std::ranges::find(row.at.levels, factor, &Level::factor);
      text += "," + (level == row.at.levels.end() ? "" : csv_field(level_text(*level)));
    }
    text += "\r\n";
  }
  return text;
}

std::vector<Result> parse_results_csv(std::string_view text, const std::string& source,
                                      const Quantities& quantities) {
  return ResultsReader(checked_text(text, source), source, quantities).read();
}

std::vector<std::string> quantities_in(std::string_view text, const std::string& source) {
  TableReader table(text, source, ',');
  TableRow row;
  std::set<std::string> found;
  if (!table.next(row)) return {};
  const auto column =
      static_cast<std::size_t>(std::ranges::find(row.cells, "quantity") - row.cells.begin());
  while (table.next(row))
    if (column < row.cells.size()) found.emplace(row.cells[column]);
  return {found.begin(), found.end()};
}

}  // namespace mapproof
