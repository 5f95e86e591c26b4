#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/files/output_folder.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// A table as text, line by line, so that some of its rows can stand in another order.
struct TableLines {
  std::string head;
  std::vector<std::string> rows;  ///< One a row of the table, with its line's end.
  std::string tail = {};
};

/// All of it.
std::string joined(const TableLines& lines);

/// Lines of table_csv and table_latex.
TableLines csv_lines(const Table& table);
TableLines latex_lines(const Table& table);

/// Comma-separated values [rfc4180], numbers unrounded, an interval as two columns, a missing value
/// as an empty field. A text that a spreadsheet would take for a formula has an apostrophe in
/// front.
std::string table_csv(const Table& table);

/// A LaTeX table in booktabs style, to be \input; needs \usepackage{booktabs} alone. One of many
/// columns is set small, its headings stacked, and centred on the line even if it is wider.
std::string table_latex(const Table& table);

/// A floating figure that includes ID.pdf at that width in points, with caption and label "fig:ID",
/// to be \input; needs \usepackage{graphicx} alone.
std::string figure_latex(const std::string& id, const std::string& caption, double width_pt);

/// A Markdown table as GitHub reads it, with the caption above and the notes below.
std::string table_markdown(const Table& table);

/// Writes ID.csv, ID.tex and ID.md of every table into `folder`.
/// @return The names of the files, sorted.
/// @throws IoError if a file cannot be written; InvalidInput if an id is none.
std::vector<std::string> write_tables(const Report& report, const OutputFolder& folder);

}  // namespace mapproof
