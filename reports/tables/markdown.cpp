#include <string_view>

#include "reports/model/format.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

/// What Markdown or the HTML in it would read as its own, as character references or escapes.
std::string escaped_markdown(const std::string& text) {
  std::string out;
  for (const char c : displayable(text)) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
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

}  // namespace

std::string table_markdown(const Table& table) {
  std::string text = "**" + escaped_markdown(table.caption) + "**\n\n|";
  for (const Column& column : table.columns) text += " " + escaped_markdown(full_heading(column)) + " |";
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
