#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/files/byte_source.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// Finds the last end of a row in bytes that become more: of a line that no quotes run on beyond.
/// Each byte is searched once.
class RowEnds {
 public:
  /// Bytes up to the last end of a row. @param bytes  Those before and more.
  std::size_t in(std::string_view bytes);

 private:
  std::size_t searched_ = 0, line_ = 0,
              whole_ = 0;  ///< Up to which; where a line and the rest begin.
  bool has_quotes_ = false, is_quoted_ = false;
};

/// Whether a table's first row is of some sort. The table stays unread; comments before the row do
/// not count. False if there is no row, or if it does not end within 16 MB.
/// @param separator  Of the cells; empty: as TableReader determines it.
/// @throws IoError if the source is empty, cannot be read, or begins with what is not a text.
bool first_row_is(ByteSource& source, const std::function<bool(const TableRow& row)>& sort,
                  std::optional<char> separator = std::nullopt);

/// The cells of the first row, as first_row_is() finds it; none if there is no row.
std::vector<std::string> first_row(ByteSource& source);

/// The rows of a table of any length, as TableReader has them; a few megabytes of it are held at a
/// time.
class TableStream {
 public:
  static constexpr std::size_t kLongestRow = std::size_t{1} << 24;

  /// @param source       Must outlive the object.
  /// @param longest_row  Bytes of a row beyond which quotes are taken not to end.
  explicit TableStream(ByteSource& source, std::size_t longest_row = kLongestRow)
      : source_(source), longest_row_(longest_row) {}

  /// @param separator  Of the cells, see TableReader.
  TableStream(ByteSource& source, char separator)
      : source_(source), longest_row_(kLongestRow), separator_(separator) {}

  /// @return Whether there was a row. @throws IoError with the line for what is not a text, for
  /// broken
  ///         quotes, a row that is too long.
  bool next(TableRow& row);

  /// As that of TableReader. @throws IoError as next().
  bool next_numbers(NumberRow& row);

  /// After the last row: it has no line end, see kCutRemark.
  bool is_cut() const { return is_cut_; }

  /// After the first row, see ByteSource and TableReader.
  std::string packing() const { return source_.form(); }
  /// Of a text that another form was made into: none.
  char separator() const { return source_.original().empty() ? separator_ : '\0'; }
  bool has_decimal_commas() const {
    return had_decimal_commas_ || (reader_ && reader_->has_decimal_commas());
  }

  const std::string& source() const { return source_.name(); }
  /// See ByteSource.
  std::optional<double> expected_size() const { return source_.expected_size(); }

 private:
  bool read_rows();

  ByteSource& source_;
  std::size_t longest_row_;
  std::string bytes_;      ///< Whole rows, then the start of the next one.
  std::size_t whole_ = 0;  ///< Bytes of them that are whole rows.
  std::size_t lines_ = 0;  ///< Before them.
  bool is_over_ = false;
  bool is_cut_ = false;
  char separator_ = '\0';            ///< NUL: not known before the first row.
  bool had_decimal_commas_ = false;  ///< Of readers before this one.
  std::optional<TableReader> reader_;
};

}  // namespace mapproof
