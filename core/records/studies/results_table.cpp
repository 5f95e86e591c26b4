#include "core/records/studies/results_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/csv.hpp"
#include "core/base/text/spelling.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestCell = 1000;
constexpr std::string_view kAt = "at.";

/// A column of text, and what it is of a result.
struct TextColumn {
  std::string_view name;
  Name Result::*text;
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

/// How many lines are in what is left of a source.
std::size_t lines_in(ByteSource& source) {
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  std::size_t lines = 0;
  for (std::string block; source.append(block, kBlock); block.clear())
    lines += static_cast<std::size_t>(std::ranges::count(block, '\n'));
  return lines;
}

/// The text, to be read as a file is. It must outlive the source.
ByteSource text_source(std::string_view text, const std::string& name) {
  return {name, [text](std::span<char> to) mutable {
            const std::size_t count = std::min(text.size(), to.size());
            std::copy_n(text.begin(), count, to.begin());
            text.remove_prefix(count);
            return count;
          }};
}

/// Reads the rows that follow a header, a few megabytes of text at a time.
class ResultsReader {
 public:
  /// @param lines  Of the table, or more: a vector of its rows may not grow by halves.
  ResultsReader(ByteSource& source, std::size_t lines, const Quantities& quantities)
      : source_(source.name()), quantities_(quantities), table_(source, ',') {
    rows_.reserve(lines);
    lines_.reserve(lines);
  }

  std::vector<Result> read() {
    if (!table_.next(row_)) throw IoError(source_, "has no header");
    read_header();
    while (table_.next(row_)) {
      if (row_.cells.size() != columns_.size())
        fail(fmt::format("{} cells where the header has {}", row_.cells.size(), columns_.size()));
      try {
        rows_.push_back(result_of_row());
      } catch (const InvalidInput& error) {  // All numbers of names are taken.
        fail(error.what());
      }
      lines_.push_back(static_cast<std::uint32_t>(row_.line));
    }
    groups_ = {};
    check_levels();
    put_in_order(order_of(rows_), [this](std::size_t a, std::size_t b) {
      std::swap(rows_[a], rows_[b]);
      std::swap(lines_[a], lines_[b]);
    });
    check_apart();
    return std::move(rows_);
  }

 private:
  /// What a column is of a result, and its last cell: most cells repeat the one above.
  struct Column {
    enum class Kind { kText, kLevel, kNumber } kind = Kind::kNumber;
    Name Result::*text = nullptr;  ///< Null: the setup.
    std::string factor = {};
    Name last = {};
  };

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
      columns_.push_back(column_of(cell));
    }
    for (const std::string_view column : needed)
      if (!there.contains(column)) fail(fmt::format("the column \"{}\" is missing", column));
    if (there.contains("group") && !there.contains("run"))
      fail("the column \"group\" needs the column \"run\": runs are what a group is of");
  }

  static Column column_of(std::string_view name) {
    using enum Column::Kind;
    if (name == kValue) return {.kind = kNumber};
    if (name == kSetup) return {.kind = kText};
    if (name.starts_with(kAt))
      return {.kind = kLevel, .factor = std::string(name.substr(kAt.size()))};
    return {.kind = kText, .text = std::ranges::find(kTextColumns, name, &TextColumn::name)->text};
  }

  Result result_of_row() {
    Result result;
    bool has_new_levels = false;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      has_new_levels = read_cell(columns_[i], row_.cells[i], result) || has_new_levels;
    if (has_new_levels) levels_ = levels_of_row();
    result.at.levels = levels_;
    if (result.method.empty()) fail("the method is missing");
    if (!known_quantity_ || result.quantity != *known_quantity_) {
      if (quantities_.find(result.quantity) == nullptr) fail(unknown_quantity(result.quantity));
      known_quantity_ = result.quantity;
    }
    if (result.group.empty()) result.group = result.run;
    const std::uint32_t run = result.run.id();
    if (run >= groups_.size()) groups_.resize(run + std::size_t{1});
    auto& [group, line] = groups_[run];
    if (line == 0) {
      group = result.group;
      line = static_cast<std::uint32_t>(row_.line);
    } else if (group != result.group) {
      fail(fmt::format("the run {} is of the group {} here and of {} on line {}",
                       in_quotes(result.run), in_quotes(result.group), in_quotes(group), line));
    }
    return result;
  }

  /// @return Whether it is a level other than that of the row above.
  bool read_cell(Column& column, std::string_view cell, Result& result) const {
    if (cell.size() > kLongestCell)
      fail(fmt::format("a cell of {} bytes; {} are allowed", cell.size(), kLongestCell));
    if (column.kind == Column::Kind::kNumber) {
      result.value = number_of(cell);
      return false;
    }
    const bool is_new = column.last != cell;
    if (is_new) column.last = cell;
    if (column.kind == Column::Kind::kLevel) return is_new;
    (column.text == nullptr ? result.at.setup : result.*column.text) = column.last;
    return false;
  }

  Levels levels_of_row() const {
    std::vector<Level> levels;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (columns_[i].kind != Column::Kind::kLevel) continue;
      const std::string_view cell = row_.cells[i];
      if (is_missing(cell)) continue;
      const std::optional<double> number = number_in(cell);
      if (number && !(std::abs(*number) <= kGreatestLevel))
        fail(fmt::format("{}: {} is beyond 1e100",
                         printable(std::string(kAt) + columns_[i].factor, 40), in_quotes(cell)));
      Level level{.factor = columns_[i].factor, .value = std::string(cell)};
      if (number) level.value = *number;
      levels.push_back(std::move(level));
    }
    return condition("", std::move(levels)).levels;
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

  /// Rows of one condition that follow each other.
  struct Block {
    std::size_t first = 0, rows = 0;
  };

  /// Throws if a factor has numbers and texts within one setup: it would have no order.
  void check_levels() {
    struct Kind {
      std::size_t rows = 0, line = 0;  ///< How many, and the first.
      std::string cell;
    };
    std::map<std::pair<std::string, std::string>, std::array<Kind, 2>> factors;
    const auto add = [&](const Block& block) {
      const Condition& at = rows_[block.first].at;
      for (const Level& level : at.levels) {
        Kind& kind = factors[{level.factor, at.setup}][level.value.index()];
        if (kind.rows == 0) kind.line = lines_[block.first], kind.cell = level_text(level);
        kind.rows += block.rows;
      }
    };
    Block block;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (rows_[i].at.levels != rows_[block.first].at.levels ||
          rows_[i].at.setup != rows_[block.first].at.setup) {
        add(block);
        block = {.first = i};
      }
      ++block.rows;
    }
    if (!rows_.empty()) add(block);
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

  const std::string source_;
  const Quantities& quantities_;
  TableStream table_;
  TableRow row_;
  std::vector<Column> columns_;
  Levels levels_;  ///< Of the last row.
  std::optional<Name> known_quantity_;
  std::vector<Result> rows_;
  std::vector<std::uint32_t> lines_;                    ///< Of each row.
  std::vector<std::pair<Name, std::uint32_t>> groups_;  ///< By number of the run; line 0: none.
};

}  // namespace

void write_results_csv(const std::vector<Result>& rows,
                       const std::function<void(const std::string&)>& write) {
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  std::set<std::string> factors;
  Levels before;
  for (const Result& row : rows) {
    if (row.at.levels != before)
      for (const Level& level : row.at.levels) factors.insert(level.factor);
    before = row.at.levels;
  }
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
    if (text.size() < kBlock) continue;
    write(text);
    text.clear();
  }
  write(text);
}

std::string results_csv(const std::vector<Result>& rows) {
  std::string all;
  write_results_csv(rows, [&all](const std::string& text) { all += text; });
  return all;
}

std::vector<Result> parse_results_csv(std::string_view text, const std::string& source,
                                      const Quantities& quantities) {
  ByteSource bytes = text_source(text, source);
  const auto lines = static_cast<std::size_t>(std::ranges::count(text, '\n'));
  return ResultsReader(bytes, lines, quantities).read();
}

std::vector<Result> read_results_csv(const std::filesystem::path& file,
                                     const Quantities& quantities) {
  std::size_t lines = 0;
  if (std::error_code error; std::filesystem::is_regular_file(file, error)) {
    ByteSource counted(file);
    lines = lines_in(counted);
  }
  ByteSource bytes(file);
  return ResultsReader(bytes, lines, quantities).read();
}

std::vector<std::string> quantities_in(const std::filesystem::path& file) {
  ByteSource bytes(file);
  TableStream table(bytes, ',');
  TableRow row;
  std::set<std::string, std::less<>> found;
  if (!table.next(row)) return {};
  const auto column =
      static_cast<std::size_t>(std::ranges::find(row.cells, "quantity") - row.cells.begin());
  while (table.next(row))
    if (column < row.cells.size() && !found.contains(row.cells[column]))
      found.emplace(row.cells[column]);
  return {found.begin(), found.end()};
}

}  // namespace mapproof
