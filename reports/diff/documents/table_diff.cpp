#include "reports/diff/documents/table_diff.hpp"

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/text/words.hpp"
#include "core/records/tables/table_reader.hpp"
#include "reports/diff/documents/excerpts.hpp"
#include "reports/diff/records/numbers_in_text.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestTable = std::size_t{1} << 26;  // Bytes.
constexpr std::size_t kMostCellText = 60;                    // Of a cell in a message.
constexpr std::array<std::string_view, 4> kVarying = {"durations", "sessions", "slam-seconds",
                                                      "slam-sessions"};

using Row = std::vector<std::string>;

struct Rows {
  std::vector<Row> rows = {};
  std::size_t heading = 0;  ///< The index of the row with the names of the columns.
  bool has_heading = false;
};

std::string trimmed_cell(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

Row cells_of(std::string_view line, char separator) {
  Row cells;
  for (std::size_t at = 0; at <= line.size();) {
    std::size_t end = line.find(separator, at);
    while (end != std::string_view::npos && end > 0 && line[end - 1] == '\\')
      end = line.find(separator, end + 1);
    end = std::min(end, line.size());
    cells.push_back(trimmed_cell(line.substr(at, end - at)));
    at = end + 1;
  }
  return cells;
}

Rows read_csv(const std::string& text, const std::string& source) {
  Rows table{.has_heading = true};
  TableReader reader(text, source, ',');
  for (TableRow row; reader.next(row);) table.rows.emplace_back(row.cells.begin(), row.cells.end());
  if (table.rows.empty()) throw IoError(source, "is empty");
  return table;
}

/// Lines; those of Markdown that begin with '|' are rows, in LaTeX every line may be one.
Rows read_lines(std::string_view text, const std::string& source, bool is_markdown) {
  Rows table;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    const bool is_row = is_markdown && line.starts_with('|');
    if (is_row && !table.has_heading) {
      table.has_heading = true;
      table.heading = table.rows.size();
    }
    table.rows.push_back(cells_of(line, is_row ? '|' : '&'));
    at = end + 1;
  }
  const bool is_whole = is_markdown ? table.has_heading
                                    : text.find("\\toprule") != std::string_view::npos &&
                                          text.find("\\end{table}") != std::string_view::npos;
  if (!is_whole) throw IoError(source, "is not a table that mapproof wrote, or is truncated");
  return table;
}

Rows read_table(const std::string& format, const fs::path& path) {
  const std::string text = read_input(path, kLargestTable);
  return format == "csv" ? read_csv(text, path.string())
                         : read_lines(text, path.string(), format == "md");
}

std::string location_of(const Rows& table, std::size_t row, std::size_t column) {
  const Row& cells = table.rows[row];
  const std::size_t label = table.has_heading && cells[0].empty() && cells.size() > 1 ? 1 : 0;
  std::string text = fmt::format("row {}", row + 1);
  if (row != table.heading && !cells[label].empty() && column != label)
    text += " (" + printable(cells[label], kMostCellText) + ")";
  const bool named = table.has_heading && column < table.rows[table.heading].size();
  return text + ", " +
         (named ? printable(table.rows[table.heading][column], kMostCellText)
                : fmt::format("cell {}", column + 1));
}

class TableComparer {
 public:
  TableComparer(const Rows& a, const Rows& b, const Tolerance& tolerance)
      : a_(a), b_(b), tolerance_(tolerance) {}

  TableDiff compare() {
    if (a_.rows.size() != b_.rows.size()) {
      tell("the table", counted(std::ssize(a_.rows), "row"), counted(std::ssize(b_.rows), "row"));
      return std::move(found_);
    }
    for (std::size_t row = 0; row < a_.rows.size(); ++row) compare_row(row);
    found_.is_style = found_.cells.shape && !body_differs_;
    return std::move(found_);
  }

 private:
  void tell(const std::string& location, const std::string& before, const std::string& after) {
    found_.cells.shape = true;
    body_differs_ = true;
    note(location, before, after);
  }

  void note(const std::string& location, const std::string& before, const std::string& after) {
    if (!found_.cells.first.empty()) return;
    found_.cells.first = location;
    std::tie(found_.cells.baseline, found_.cells.current) = excerpts(before, after, kMostCellText);
  }

  void compare_row(std::size_t row) {
    const Row &first = a_.rows[row], &second = b_.rows[row];
    if (first.size() != second.size())
      return tell(fmt::format("row {}", row + 1), counted(std::ssize(first), "cell"),
                  counted(std::ssize(second), "cell"));
    for (std::size_t i = 0; i < first.size(); ++i) {
      found_.cells.numbers += static_cast<long>(numbers_in(first[i]).size());
      const TextChange change = text_change(first[i], second[i], tolerance_);
      if (change == TextChange::kNone) continue;
      if (change == TextChange::kWithin) {
        ++found_.cells.within;
        continue;
      }
      note(location_of(a_, row, i), first[i], second[i]);
      const bool is_body = a_.has_heading ? row > a_.heading : first.size() > 1;
      body_differs_ |= is_body;
      if (change == TextChange::kNumbers && is_body)
        ++found_.cells.beyond;
      else
        found_.cells.shape = true;
    }
  }

  const Rows &a_, &b_;
  Tolerance tolerance_;
  TableDiff found_;
  bool body_differs_ = false;
};

}  // namespace

bool varies(std::string_view table) {
  return table.starts_with("seconds--") || table.starts_with("sessions--") ||
         std::ranges::find(kVarying, table) != kVarying.end();
}

TableDiff table_diff(const std::string& format, const fs::path& baseline, const fs::path& current,
                     const Tolerance& tolerance) {
  const Rows a = read_table(format, baseline), b = read_table(format, current);
  TableDiff diff = TableComparer(a, b, tolerance).compare();
  diff.cells.file = baseline.filename().string();
  return diff;
}

bool same_headings(const std::string& format, const fs::path& baseline, const fs::path& current) {
  const Rows a = read_table(format, baseline), b = read_table(format, current);
  return a.has_heading == b.has_heading &&
         (!a.has_heading || a.rows[a.heading] == b.rows[b.heading]);
}

}  // namespace mapproof
