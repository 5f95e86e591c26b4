#include "core/records/tables/table_reader.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/ascii.hpp"
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
    else if (is_digit(c) ||
             ((c == '-' || c == '+') && (i == 0 || cell[i - 1] == 'e' || cell[i - 1] == 'E')) ||
             ((c == 'e' || c == 'E') && i > comma))
      number += c;
    else if (!is_group)
      return {};
  }
  return number;
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

/// A plain number at the start of a text, and where it ends; null: there is none.
const char* plain_number(const char* at, const char* end, double& value) {
  constexpr std::array<double, 16> kPowers = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                              1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const char* const start = at;
  const bool is_negative = at < end && *at == '-';
  if (is_negative) ++at;
  const auto digit = [&] { return static_cast<unsigned>(static_cast<unsigned char>(*at)) - '0'; };
  std::uint64_t digits = 0;
  const char* const whole = at;
  for (; at < end && digit() < 10; ++at) digits = 10 * digits + digit();
  const auto before = at - whole;
  std::ptrdiff_t after = 0;
  if (at < end && *at == '.') {
    const char* const fraction = ++at;
    for (; at < end && digit() < 10; ++at) digits = 10 * digits + digit();
    after = at - fraction;
    if (after == 0) return nullptr;
  }
  if (before == 0) return nullptr;
  // Up to 15 digits both are exact, so that one rounding is all; the rest is the library's.
  if (before + after <= 15 && (at == end || (*at | ' ') != 'e')) {
    const double size = static_cast<double>(digits) / kPowers[static_cast<std::size_t>(after)];
    value = is_negative ? -size : size;
    return at;
  }
  const auto [stop, error] = std::from_chars(start, end, value);
  return error == std::errc() ? stop : nullptr;
}

/// The cells of one row, without quotes.
class PlainCells {
 public:
  PlainCells(const char* at, const char* end, char separator)
      : at_(at), end_(end), separator_(separator) {}

  const char* at() const { return at_; }

  /// Whether a row with content, which is not a comment, starts here.
  bool starts_row() {
    if (separator_ == TableReader::kBlanks) skip_blanks();
    return at_ < end_ && *at_ != '\n' && *at_ != '\r' && *at_ != '#' && *at_ != ' ' && *at_ != '\t';
  }

  /// @param is_last  Whether the row ends behind the cell. @return False if it is not plain.
  bool take(double& value, bool& is_last) {
    skip_blanks();
    if (const char* stop = plain_number(at_, end_, value)) {
      at_ = stop;
      return ends_cell(is_last);
    }
    value = kNaN;
    return is_missing(take_text()) && ends_cell(is_last);
  }

  bool take_first(NumberRow& row, bool& is_last) {
    const char* const start = at_;
    double value = 0.0;
    const char* const stop = plain_number(at_, end_, value);
    if (stop != nullptr) {
      at_ = stop;
      if (ends_cell(is_last)) {
        row.first = std::string_view(start, static_cast<std::size_t>(stop - start));
        row.starts_as_text = false;
        row.values.front() = value;
        return true;
      }
      at_ = start;
    }
    const bool is_quoted = at_ < end_ && *at_ == '"';
    if (is_quoted) {
      const char* const close = std::find(++at_, end_, '"');
      row.first = std::string_view(at_, static_cast<std::size_t>(close - at_));
      if (close == end_ || row.first.find('\n') != std::string_view::npos) return false;
      at_ = close + 1;
    } else {
      row.first = take_text();
    }
    // A decimal comma, or a quote within, is left to next().
    if (!is_quoted && row.first.find_first_of(",\"+") != std::string_view::npos) return false;
    row.starts_as_text = !is_missing(row.first);
    // Perhaps a rule; or a number in another form, ".5" or in quotes.
    if (row.starts_as_text && (row.first.starts_with('-') || number_in(row.first))) return false;
    return ends_cell(is_last);
  }

 private:
  bool is_blank(char c) const { return c == ' ' || (c == '\t' && separator_ != '\t'); }

  void skip_blanks() {
    while (at_ < end_ && is_blank(*at_)) ++at_;
  }

  /// Up to the end of the cell, without the blanks there.
  std::string_view take_text() {
    const char* const start = at_;
    while (at_ < end_ && *at_ != separator_ && *at_ != '\n' && *at_ != '\r' &&
           (separator_ != TableReader::kBlanks || !is_blank(*at_)))
      ++at_;
    return bare({start, static_cast<std::size_t>(at_ - start)}, separator_);
  }

  /// Passes over what ends a cell; false: something else follows.
  bool ends_cell(bool& is_last) {
    const char* const start = at_;
    skip_blanks();
    if (at_ < end_ && *at_ == '\r' && (at_ + 1 == end_ || at_[1] == '\n')) ++at_;
    is_last = at_ == end_ || *at_ == '\n';
    if (is_last) {
      if (at_ < end_) ++at_;
      return true;
    }
    if (separator_ == TableReader::kBlanks) return at_ > start;
    return *at_++ == separator_;
  }

  const char* at_;
  const char* end_;
  char separator_;
};

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

char TableReader::separator_in(std::string_view text) {
  const std::string_view row = first_row(text);
  return row.empty() ? '\0' : separator_of(row);
}

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
        !content.empty() && content.front() != '#' && !(line_ == 1 && stated_separator(content));
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

bool TableReader::next_numbers(NumberRow& row) {
  row.values.clear();
  const char* const end = text_.data() + text_.size();
  PlainCells cells(text_.data() + at_, end, separator_);
  // What next() passes over, or refuses, is left to it.
  if (!cells.starts_row() || (line_ == 1 && stated_separator(trimmed(rest_of_line()))))
    return false;
  row.line = line_;
  bool is_last = false;
  row.values.push_back(kNaN);
  if (!cells.take_first(row, is_last)) return false;
  while (!is_last) {
    double value = 0.0;
    if (!cells.take(value, is_last)) return false;
    row.values.push_back(value);
  }
  if (row.values.size() == 1 && row.starts_as_text) return false;
  at_ = static_cast<std::size_t>(cells.at() - text_.data());
  ++line_;
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
