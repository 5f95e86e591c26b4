#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/base/files/byte_source.hpp"
#include "core/records/ranges/range_tables.hpp"
#include "core/records/tables/column_names.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// A column of a range log's table of CSV.
struct RangeColumn {
  ColumnRole role;
  std::string_view label;               ///< For errors.
  std::vector<std::string_view> words;  ///< What the header may call it, besides the usual words of
                                        ///< the role; in small letters, joined.
  bool is_needed = true;
};

/// @throws IoError naming the headers that there are, if the user names a column of that role that
///         the table does not have.
void require_named(ColumnRole role, const TableRow& header, const std::string& source,
                   const ColumnNames& names);

/// Of the columns those that are needed and that a header does not name.
std::vector<ColumnRole> missing_columns(const TableRow& header,
                                        const std::vector<RangeColumn>& columns,
                                        const ColumnNames& names = {});

/// Of times, landmarks and ranges those that a header does not name. Empty: it is that of ranges.
std::vector<ColumnRole> missing_range_columns(const TableRow& header, const ColumnNames& names);

/// The columns of a CSV table in the order asked for, whatever their order there, in seconds,
/// metres and radians; others are passed over, and so are those that are neither needed nor there.
/// A column of nanoseconds is added to the times. Rows whose range is missing are left out, and
/// counted.
///
/// @param numbers    The times first, if they are among them.
/// @param landmarks  Whether the names of landmarks are read as well.
/// @param names      Columns that the user names; each counts in the tables that have it.
/// @throws IoError naming the line if there is no such header, a needed column is not there or
///         twice, or a cell of one is not a finite number or an empty name.
NumberTable read_range_columns(ByteSource& input, const std::vector<RangeColumn>& numbers,
                               bool landmarks, const ColumnNames& names);

}  // namespace mapproof
