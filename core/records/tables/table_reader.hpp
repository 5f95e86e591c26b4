#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// One row of a text table. The cells live until the next row is read.
struct TableRow {
  std::size_t line = 0;  ///< Where it starts, from 1.
  std::vector<std::string_view> cells;
};

/// One row of which all cells but the first are numbers, or missing. It lives as TableRow does.
struct NumberRow {
  std::size_t line = 0;
  std::string_view first;       ///< The first cell as it is.
  bool starts_as_text = false;  ///< It is neither a number nor missing.
  std::vector<double> values;   ///< Of all cells; NaN: missing, or that text.
};

/// The remark on a table whose last row has no line end.
inline constexpr const char* kCutRemark = "The last line has no line end: it may be cut.";

/// And if nothing can be made of that row, where it does not stop the reader.
inline constexpr const char* kCutOffRemark =
    "The last line has no line end and cannot be read: it is cut, and left out.";

/// Whether the text ends within a row, without a line end.
bool is_cut_table(std::string_view text);

/// Reads a table row by row: RFC 4180 with commas, semicolons or tabs, LF or CR LF, cells in quotes
/// or not, or with runs of blanks between cells. Blanks around bare cells, empty lines and lines
/// that start with '#' are passed over. Decimal commas become points where commas do not separate.
/// Linear in the size of the text.
class TableReader {
 public:
  /// The separator is what the first row holds outside quotes: a tab, else a semicolon, else a
  /// comma, else blanks. A first line such as "sep=;" states it.
  /// @param text  From checked_text(); must outlive the reader, as must `source`.
  TableReader(std::string_view text, const std::string& source);

  static constexpr char kBlanks = ' ';  ///< A separator: any number of spaces and tabs.
  /// @param first_line  Number of the text's first line, for what is a part of a file.
  TableReader(std::string_view text, const std::string& source, char separator,
              std::size_t first_line = 1);

  /// What separates the cells of the text's first row; '\0' if it has none.
  static char separator_in(std::string_view text);

  /// @return Whether there was a row.
  /// @throws IoError with the line for broken quotes, and for lines that end with CR alone.
  bool next(TableRow& row);

  /// Reads the next row faster than next() does, if its cells are plain: numbers with a decimal
  /// point and without a sign '+', or missing, and none in quotes but the first.
  /// @return False: the row is not such a one, or there is none; it is still to be read by next().
  bool next_numbers(NumberRow& row);

  /// Whether the text is read; what follows may still be no row.
  bool is_over() const { return at_ >= text_.size(); }

  char separator() const { return separator_; }
  /// Whether a row so far had decimal commas.
  bool has_decimal_commas() const { return has_decimal_commas_; }

 private:
  void check_line_ends() const;
  bool skip_to_row();
  void split_blanks(std::string_view line, TableRow& row);
  void split_bare(std::string_view line, TableRow& row) const;
  void split_quoted(TableRow& row);
  void split(TableRow& row);
  void take_decimal_commas(TableRow& row);
  std::string_view quoted_cell(std::size_t row_line);
  std::string_view rest_of_line() const;
  /// Of a bare cell that starts at the cursor.
  std::size_t cell_end() const;

  std::string_view text_;
  const std::string& source_;
  char separator_;
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  bool has_decimal_commas_ = false;
  std::deque<std::string> unescaped_;  ///< Of the current row.
};

}  // namespace mapproof
