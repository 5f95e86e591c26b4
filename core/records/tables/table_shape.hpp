#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

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

/// Recognises how a table lies, unless the user says so.
///
/// Certainly transposed: the header's first cell names steps or times; the first column holds
/// dates; or the header names landmarks, and the first column counts, ascends or holds values.
/// Certainly wide: the rows have names that are texts; or the header names or counts steps. In
/// doubt: more rows than columns whose rows have no names, or numbers that ascend.
/// @param text  From checked_text(). @throws IoError as TableReader, or as require_columns().
/// @note Splits the whole table once.
TableShape table_shape(std::string_view text, const std::string& source, const TableFormat& format);

}  // namespace mapproof
