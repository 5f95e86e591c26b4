#include "reports/tables/write_tables.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/text/csv.hpp"
#include "core/base/text/markup.hpp"
#include "core/base/text/unit_text.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

/// A spreadsheet would take such a text for a formula; the sign in front makes it a text.
std::string harmless(const std::string& text) {
  constexpr std::string_view kBegins = "=+-@\t\r\n";
  const std::string shown = displayable(text);
  const bool acts = !shown.empty() && kBegins.find(shown.front()) != std::string_view::npos;
  return csv_field(acts ? "'" + shown : shown);
}

struct Writer {
  bool interval;  ///< The column takes two fields.

  std::string one(const std::string& text) const { return interval ? text + "," : text; }
  std::string operator()(const TextCell& cell) const { return one(harmless(cell.text)); }
  std::string operator()(const NumberCell& cell) const { return one(csv_number(cell.value)); }
  std::string operator()(const IntervalCell& cell) const {
    return csv_number(cell.low) + "," + csv_number(cell.high);
  }
  std::string operator()(const MissingCell&) const { return one(""); }
};

/// Characters outside ASCII that our own texts use; others go through as UTF-8.
constexpr std::array<std::pair<std::string_view, std::string_view>, 21> kSymbols = {{
    {"\u03C3\u00B2", "$\\sigma^2$"},
    {"\u03C7\u00B2", "$\\chi^2$"},
    {"\u03C7", "$\\chi$"},
    {"\u2212", "$-$"},
    {"\u2013", "--"},
    {"\u2014", "---"},
    {"\u2018", "`"},
    {"\u2019", "'"},
    {"\u201C", "``"},
    {"\u201D", "''"},
    {"\u2026", "\\ldots{}"},
    {"\u00D7", "$\\times$"},
    {"\u00B1", "$\\pm$"},
    {"\u00B2", "$^2$"},
    {"\u00B0", "$^\\circ$"},
    {"\u03C3", "$\\sigma$"},
    {"\u00B5", "$\\mu$"},
    {"\u2264", "$\\le$"},
    {"\u2265", "$\\ge$"},
    {"\u00A0", "~"},
    {"\u2192", "$\\to$"},
}};

std::string_view ascii(char c) {
  switch (c) {
    case '&':
      return "\\&";
    case '%':
      return "\\%";
    case '$':
      return "\\$";
    case '#':
      return "\\#";
    case '_':
      return "\\_";
    case '{':
      return "\\{";
    case '}':
      return "\\}";
    case '~':
      return "\\textasciitilde{}";
    case '^':
      return "\\textasciicircum{}";
    case '\\':
      return "\\textbackslash{}";
    case '<':
      return "\\textless{}";
    case '>':
      return "\\textgreater{}";
    case '|':
      return "\\textbar{}";
    case '"':
      return "{\\char34}";
    case '[':
      return "{[}";  // After \\ a bare one would be its optional argument.
    case '\n':
    case '\t':
      return " ";
    default:
      return {};
  }
}

std::string escaped_latex(const std::string& raw) {
  const std::string text = displayable(raw);
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    std::string_view replacement = ascii(text[at]);
    std::size_t length = 1;
    for (const auto& [symbol, latex] : kSymbols)
      if (replacement.empty() && text.compare(at, symbol.size(), symbol) == 0) {
        replacement = latex;
        length = symbol.size();
      }
    replacement.empty() ? out += text[at] : out += replacement;
    at += length;
  }
  return out;
}

constexpr std::size_t kManyColumns = 8;    ///< From here on a table is tight for a page.
constexpr std::size_t kShortHeading = 10;  ///< Characters of a line of its headings.

/// "95 % interval [m]", in a tight table one word under the other as far as they are long.
std::string heading(const Table& table, std::size_t index) {
  const Column& column = table.columns[index];
  const std::string title =
      column.unit.empty() ? column.title : column.title + " [" + column.unit + "]";
  if (table.columns.size() < kManyColumns || title.size() <= kShortHeading)
    return escaped_latex(title);
  std::string lines;
  std::size_t length = 0;  ///< Of the last line.
  for (std::size_t at = 0; at < title.size();) {
    const std::size_t end = std::min(title.find(' ', at), title.size());
    const std::string word = title.substr(at, end - at);
    const bool fits = length > 0 && length + 1 + word.size() <= kShortHeading;
    if (length > 0) lines += fits ? " " : "\\\\";
    length = fits ? length + 1 + word.size() : word.size();
    lines += escaped_latex(word);
    at = end + 1;
  }
  return fmt::format("\\shortstack[{}]{{{}}}", holds_text(table, index) ? 'l' : 'r', lines);
}

/// The line of group headings with its rules, empty if no column has a group.
std::string group_line(const Table& table) {
  std::string line;
  std::string rules;
  bool any = false;
  const auto& columns = table.columns;
  for (std::size_t i = 0; i < columns.size();) {
    std::size_t end = i + 1;
    while (end < columns.size() && columns[end].group == columns[i].group) ++end;
    if (i > 0) line += " & ";
    if (columns[i].group.empty()) {
      for (std::size_t k = i + 1; k < end; ++k) line += "& ";
    } else {
      any = true;
      line +=
          fmt::format("\\multicolumn{{{}}}{{c}}{{{}}}", end - i, escaped_latex(columns[i].group));
      rules += fmt::format("\\cmidrule(lr){{{}-{}}}", i + 1, end);
    }
    i = end;
  }
  return any ? "  " + line + " \\\\\n  " + rules + "\n" : "";
}

/// What Markdown or the HTML in it would read as its own, as character references or escapes.
std::string escaped_markdown(const std::string& text) {
  std::string out;
  for (const char c : displayable(text)) {
    if (const std::string_view reference = markup_reference(c); c != '"' && !reference.empty()) {
      out += reference;
      continue;
    }
    switch (c) {
      case '\n':
        out += "<br>";
        break;
      case '\t':
        out += ' ';
        break;
      default:
        if (std::string_view("\\`*_{}[]()#+!|~$@:").find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
  }
  return out;
}

/// Words are escaped; numbers need none ("+0.01" and "1.00e+07" are read as they stand).
std::string cell_text(const Cell& cell) {
  if (const auto* text = std::get_if<TextCell>(&cell)) return escaped_markdown(text->text);
  return format_cell(cell);
}

/// With the digits of a number for its title.
Column plain_column(Column column) {
  if (column.number) column.title = csv_number(*column.number);
  return column;
}

}  // namespace

std::string joined(const TableLines& lines) {
  std::string text = lines.head;
  for (const std::string& row : lines.rows) text += row;
  return text + lines.tail;
}

std::vector<std::string> write_tables(const Report& report, const OutputFolder& folder) {
  check(report);  // The ids become file names.
  std::vector<std::string> written;
  const auto write = [&](const std::string& file, const std::string& text) {
    folder.write(file, text);
    written.push_back(file);
  };
  for (const Table* table : tables(report)) {
    write(table->id + ".csv", table_csv(*table));
    write(table->id + ".tex", table_latex(*table));
    write(table->id + ".md", table_markdown(*table));
  }
  std::ranges::sort(written);
  return written;
}

TableLines csv_lines(const Table& table) {
  TableLines lines;
  std::vector<bool> intervals;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    intervals.push_back(holds_intervals(table, i));
    const std::string title = with_plain_spaces(full_heading(plain_column(table.columns[i])));
    if (i > 0) lines.head += ',';
    lines.head += intervals[i] ? harmless(title + ", low") + "," + harmless(title + ", high")
                               : harmless(title);
  }
  lines.head += "\r\n";
  for (const Row& row : table.rows) {
    std::string text;
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      text += (i > 0 ? "," : "") + std::visit(Writer{intervals[i]}, row.cells[i]);
    lines.rows.push_back(text + "\r\n");
  }
  return lines;
}

std::string table_csv(const Table& table) { return joined(csv_lines(table)); }

TableLines latex_lines(const Table& table) {
  std::string format;
  std::string titles;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    format += holds_text(table, i) ? 'l' : 'r';
    titles += (i > 0 ? " & " : "") + heading(table, i);
  }
  const bool tight = table.columns.size() >= kManyColumns;
  TableLines lines;
  lines.head =
      fmt::format("\\begin{{table}}\n  \\centering\n  \\{}\n  \\setlength{{\\tabcolsep}}{{{}pt}}\n",
                  tight ? "scriptsize" : "footnotesize", tight ? 2 : 3) +
      "  \\caption{" + escaped_latex(table.caption) + "}\n  \\label{tab:" + table.id +
      "}\n  \\makebox[\\linewidth]{\\begin{tabular}{" + format + "}\n  \\toprule\n" +
      group_line(table) + "  " + titles + " \\\\\n  \\midrule\n";
  for (const Row& row : table.rows) {
    std::string line;
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const std::string cell = escaped_latex(format_cell(row.cells[i]));
      line += (i > 0 ? " & " : "") + (row.marked ? "\\textbf{" + cell + "}" : cell);
    }
    lines.rows.push_back("  " + line + " \\\\\n");
  }
  lines.tail = "  \\bottomrule\n  \\end{tabular}}\n";
  for (const std::string& note : table.notes)
    lines.tail +=
        "  \\par\\smallskip{\\footnotesize\\raggedright " + escaped_latex(note) + "\\par}\n";
  lines.tail += "\\end{table}\n";
  return lines;
}

std::string table_latex(const Table& table) { return joined(latex_lines(table)); }

std::string figure_latex(const std::string& id, const std::string& caption, double width_pt) {
  constexpr double kPointsPerInch = 72.0;
  return fmt::format(
      "% Needs \\usepackage{{graphicx}}.\n"
      "\\begin{{figure}}\n"
      "  \\centering\n"
      "  \\includegraphics[width={:.6g}in]{{{}.pdf}}\n"
      "  \\caption{{{}}}\n"
      "  \\label{{fig:{}}}\n"
      "\\end{{figure}}\n",
      width_pt / kPointsPerInch, id, escaped_latex(caption), id);
}

std::string table_markdown(const Table& table) {
  std::string text = "**" + escaped_markdown(table.caption) + "**\n\n|";
  for (const Column& column : table.columns)
    text += " " + escaped_markdown(full_heading(column)) + " |";
  text += "\n|";
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    text += holds_text(table, i) ? " :--- |" : " ---: |";
  text += '\n';
  for (const Row& row : table.rows) {
    text += '|';
    for (const Cell& cell : row.cells)
      text += row.marked ? " **" + cell_text(cell) + "** |" : " " + cell_text(cell) + " |";
    text += '\n';
  }
  for (const std::string& note : table.notes) text += "\n" + escaped_markdown(note) + "\n";
  return text;
}

}  // namespace mapproof
