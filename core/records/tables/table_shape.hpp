#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/records/observations/sources.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// How a table of landmarks times steps lies, and what its first row and column hold.
struct TableShape {
  bool is_transposed = false;    ///< Rows are steps.
  bool has_header = false;       ///< The first row holds no values.
  bool is_header_short = false;  ///< It names no column of row names, as R writes tables.
  /// Of names (wide) or of times (transposed).
  std::optional<std::size_t> label_column;
  bool has_dates = false;  ///< The times are dates.
  /// Why the layout cannot be determined, and the options that state it; empty: it is certain.
  std::string doubt;
};

/// Recognises, row by row, how a table lies, unless the user says so.
///
/// Certainly transposed: the header's first cell names steps or times; the first column holds
/// dates; or the header names landmarks, and the first column counts, ascends or holds values.
/// Certainly wide: the rows have names that are texts; or the header names or counts steps. In
/// doubt: more rows than columns whose rows have no names, or numbers that ascend.
class TableShapes {
 public:
  /// @param first  Row. @throws IoError as require_columns().
  TableShapes(const TableRow& first, const std::string& source, const TableFormat& stated);

  bool has_header() const { return has_header_; }
  /// Cells of the first row, and one in front if it is a header that lacks it.
  std::size_t columns() const { return columns_; }
  /// The first row, such a cell included; the first of them alone once it is certain that the rest
  /// is of no use.
  const std::vector<std::string>& first() const { return first_; }
  bool is_header_short() const { return is_header_short_; }

  /// Another row, by its first cell and how many it has.
  void add(std::string_view label, std::size_t cells);
  /// The same where that cell is a number.
  void add(double label, std::size_t cells);

  /// How the table lies, of the rows so far.
  TableShape shape() const;

 private:
  /// The content of the cells of a first column, below the header.
  struct Labels {
    std::size_t rows = 0;
    std::size_t texts = 0;
    std::size_t dates = 0;
    bool ascends = true;  ///< All are numbers, each above the one before.
    double last = 0.0;

    void add(std::string_view cell);
    void add(double number);

    bool are_names() const { return texts > 0; }
    bool are_dates() const { return texts == 0 && dates > 0; }
    bool are_times() const;
  };

  void take_second(std::size_t cells);
  void drop_first();
  std::size_t value_columns() const;
  std::string doubt_of(std::string_view why) const;
  void recognise_with_header(TableShape& shape) const;
  void recognise_layout(TableShape& shape) const;
  std::optional<std::size_t> label_column(const TableShape& shape) const;

  TableFormat format_;
  std::vector<std::string> first_;
  std::size_t columns_;
  bool has_header_ = false;
  bool is_header_short_ = false;
  bool is_second_ = true;  ///< The next row is.
  Labels labels_;
};

}  // namespace mapproof
