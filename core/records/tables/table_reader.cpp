#include "core/records/tables/table_reader.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

/// The first line with content.
std::string_view first_row(std::string_view text) {
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    if (!line.empty() && line.front() != '#') return line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return text;
}

/// The separator that a line such as "sep=;" states, as spreadsheets write and read it.
std::optional<char> stated_separator(std::string_view row) {
  if (row.size() != 5 || lower_case(row.substr(0, 4)) != "sep=") return std::nullopt;
  return row[4];
}

char separator_of(std::string_view row) {
  if (const std::optional<char> stated = stated_separator(row)) return *stated;
  bool is_quoted = false;
  bool has_semicolon = false, has_comma = false, has_blank = false, has_bar = false;
  for (const char c : row) {
    if (c == '"') is_quoted = !is_quoted;
    if (is_quoted) continue;
    if (c == '\t') return '\t';
    has_semicolon = has_semicolon || c == ';';
    has_comma = has_comma || c == ',';
    has_blank = has_blank || c == ' ';
    has_bar = has_bar || c == '|';
  }
  if (has_semicolon) return ';';
  if (has_bar && !has_comma) return '|';  // As sqlite3 and psql print tables.
  return has_blank && !has_comma ? TableReader::kBlanks : ',';
}

/// "-1.234,5" as "-1234.5": a number with a decimal comma. Empty if the cell is none.
std::string with_decimal_point(std::string_view cell) {
  const std::size_t comma = cell.find(',');
  if (comma == std::string_view::npos || comma + 1 == cell.size() || comma == 0) return {};
  std::string number;
  for (std::size_t i = 0; i < cell.size(); ++i) {
    const char c = cell[i];
    const bool is_group = c == '.' && i + 3 < cell.size() && i < comma && (comma - i) % 4 == 0;
    if (c == ',' && i == comma)
      number += '.';
    else if ((c >= '0' && c <= '9') ||
             ((c == '-' || c == '+') && (i == 0 || cell[i - 1] == 'e' || cell[i - 1] == 'E')) ||
             ((c == 'e' || c == 'E') && i > comma))
      number += c;
    else if (!is_group)
      return {};
  }
  return number;
}

/// Whether a row underlines a header: "----  --------".
bool is_rule(const TableRow& row) {
  constexpr std::size_t kShortest = 3;  // "--" is a missing value.
  bool is_long = false;
  for (const std::string_view cell : row.cells) {
    if (cell.empty() || cell.find_first_not_of('-') != std::string_view::npos) return false;
    is_long = is_long || cell.size() >= kShortest;
  }
  return is_long;
}

/// As trimmed(), but a tab that separates is not a blank.
std::string_view bare(std::string_view cell, char separator) {
  const auto is_blank = [&](char c) {
    return c == ' ' || c == '\r' || (c == '\t' && separator != '\t');
  };
  while (!cell.empty() && is_blank(cell.front())) cell.remove_prefix(1);
  while (!cell.empty() && is_blank(cell.back())) cell.remove_suffix(1);
  return cell;
}

}  // namespace

bool is_cut_table(std::string_view text) {
  const std::string_view last = trimmed(text.substr(text.rfind('\n') + 1));
  return !last.empty() && last.front() != '#';
}

TableReader::TableReader(std::string_view text, const std::string& source)
    : TableReader(text, source, separator_in(text)) {}

TableReader::TableReader(std::string_view text, const std::string& source, char separator,
                         std::size_t first_line)
    : text_(text), source_(source), separator_(separator), line_(first_line) {}

char TableReader::separator_in(std::string_view text) { return separator_of(first_row(text)); }

std::string_view TableReader::rest_of_line() const {
  return text_.substr(at_, std::min(text_.find('\n', at_), text_.size()) - at_);
}

std::size_t TableReader::cell_end() const {
  const std::array<char, 2> ends = {separator_, '\n'};
  return std::min(text_.find_first_of(ends.data(), at_, ends.size()), text_.size());
}

bool TableReader::skip_to_row() {
  while (at_ < text_.size()) {
    const std::string_view line = rest_of_line();
    const std::string_view content = trimmed(line);
    const bool is_row =
        !content.empty() && content.front() != '#' && !(at_ == 0 && stated_separator(content));
    // A line of tabs alone is a row of empty cells, if tabs separate.
    if (is_row ||
        (separator_ == '\t' && line.find('\t') != std::string_view::npos && content.empty()))
      return true;
    at_ = std::min(at_ + line.size() + 1, text_.size());
    ++line_;
  }
  return false;
}

/// Throws where carriage returns stand for line feeds: all rows would be one.
void TableReader::check_line_ends() const {
  const std::string_view content = trimmed(text_);
  if (content.find_first_of("\n\"") == std::string_view::npos &&
      content.find('\r') != std::string_view::npos)
    throw IoError(source_, fmt::format("line {}", line_),
                  "the lines end with carriage returns alone; line feeds are needed");
}

bool TableReader::next(TableRow& row) {
  if (at_ == 0) check_line_ends();
  do {
    row.cells.clear();
    unescaped_.clear();
    if (!skip_to_row()) return false;
    row.line = line_;
    split(row);
  } while (is_rule(row));
  if (separator_ != ',') take_decimal_commas(row);
  return true;
}

void TableReader::split(TableRow& row) {
  const std::string_view line = rest_of_line();
  if (separator_ != kBlanks && line.find('"') != std::string_view::npos) return split_quoted(row);
  if (separator_ == kBlanks)
    split_blanks(line, row);
  else
    split_bare(line, row);
  at_ = std::min(at_ + line.size() + 1, text_.size());
  ++line_;
}

void TableReader::take_decimal_commas(TableRow& row) {
  for (std::string_view& cell : row.cells) {
    if (cell.size() > 40 || cell.find(',') == std::string_view::npos) continue;
    std::string number = with_decimal_point(cell);
    if (number.empty()) continue;
    has_decimal_commas_ = true;
    cell = unescaped_.emplace_back(std::move(number));
  }
}

/// Cells in quotes hold no quotes, as programs that write blanks between cells have it.
void TableReader::split_blanks(std::string_view line, TableRow& row) {
  for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
    const bool is_quoted = line.front() == '"';
    std::size_t end = is_quoted ? line.find('"', 1) : line.find_first_of(" \t\r");
    if (is_quoted && end == std::string_view::npos)
      throw IoError(source_, fmt::format("line {}", line_), "a cell in quotes does not end");
    end = std::min(end, line.size());
    row.cells.push_back(line.substr(is_quoted ? 1 : 0, is_quoted ? end - 1 : end));
    line.remove_prefix(std::min(end + (is_quoted ? 1 : 0), line.size()));
  }
}

void TableReader::split_bare(std::string_view line, TableRow& row) const {
  for (;;) {
    const std::size_t end = line.find(separator_);
    row.cells.push_back(bare(line.substr(0, end), separator_));
    if (end == std::string_view::npos) return;
    line.remove_prefix(end + 1);
  }
}

/// Cell by cell, since cells in quotes may hold separators and ends of lines.
void TableReader::split_quoted(TableRow& row) {
  for (;;) {
    const std::size_t first = at_;
    while (at_ < text_.size() && text_[at_] != separator_ &&
           (text_[at_] == ' ' || text_[at_] == '\t'))
      ++at_;
    if (at_ < text_.size() && text_[at_] == '"') {
      row.cells.push_back(quoted_cell(row.line));
    } else {
      at_ = cell_end();
      row.cells.push_back(bare(text_.substr(first, at_ - first), separator_));
    }
    if (at_ == text_.size()) return;
    const char end = text_[at_++];
    if (end == '\n') {
      ++line_;
      return;
    }
  }
}

/// The cell that opens at the cursor, which then stands at the separator or the line's end.
std::string_view TableReader::quoted_cell(std::size_t row_line) {
  const std::size_t first = ++at_;
  std::size_t close = text_.find('"', first);
  bool has_escapes = false;
  while (close != std::string_view::npos && close + 1 < text_.size() && text_[close + 1] == '"') {
    has_escapes = true;
    close = text_.find('"', close + 2);
  }
  if (close == std::string_view::npos)
    throw IoError(source_, fmt::format("line {}", row_line), "a cell in quotes does not end");
  std::string_view cell = text_.substr(first, close - first);
  line_ += static_cast<std::size_t>(std::ranges::count(cell, '\n'));
  at_ = close + 1;
  const std::size_t end = cell_end();
  const std::string_view behind = bare(text_.substr(at_, end - at_), separator_);
  if (!behind.empty())
    throw IoError(source_, fmt::format("line {}", line_),
                  "text behind a closing quote: " + in_quotes(behind));
  at_ = end;
  if (!has_escapes) return cell;
  std::string& plain = unescaped_.emplace_back();
  for (std::size_t i = 0; i < cell.size(); ++i) {
    plain += cell[i];
    if (cell[i] == '"') ++i;
  }
  return plain;
}

}  // namespace mapproof
