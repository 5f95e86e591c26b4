#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>

#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// The rows of a table whose bytes come piece by piece, as of a file that grows, or a pipe. A row
/// is one line, and there once the line's end is; else rows are as TableReader has them, and the
/// first one determines what separates the cells of all.
class StreamedTable {
 public:
  using TakeRow = std::function<void(const TableRow& row)>;

  /// @param source  What to call the table in errors.
  explicit StreamedTable(std::string source) : source_(std::move(source)) {}
  StreamedTable(const StreamedTable&) = delete;
  StreamedTable& operator=(const StreamedTable&) = delete;

  /// @throws IoError with the line for what is not a text, for broken quotes or a cell that goes
  /// over
  ///         the line's end, a line of more than 1 MiB; and what `take_row` throws.
  void take(std::string_view bytes, const TakeRow& take_row);

  /// Forgets a line whose end has not come, as of a file that is still being written.
  void drop_half_line() { pending_.clear(); }

  /// There will be no more: the last line needs no end. One that has none and cannot be read is
  /// left out, unless it is the first.
  void end(const TakeRow& take_row);

  /// After end(): the remark on a last line without an end; null if it had one.
  const char* cut_remark() const { return cut_remark_; }

  const std::string& source() const { return source_; }

 private:
  void read_line(std::string_view line, const TakeRow& take_row);

  std::string source_;
  std::string pending_;    ///< A line whose end has not come.
  std::size_t line_ = 0;   ///< The last one read.
  char separator_ = '\0';  ///< Not known before the first row.
  const char* cut_remark_ = nullptr;
};

}  // namespace mapproof
