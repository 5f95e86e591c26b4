#pragma once

#include <string_view>
#include <vector>

#include "core/base/byte_source.hpp"
#include "core/records/observations/table_reader.hpp"
#include "core/records/ranges/range_tables.hpp"

namespace mapproof {

/// A column that a table names in its header.
struct CsvColumn {
  std::string_view label;               ///< For errors.
  std::vector<std::string_view> words;  ///< What the header may call it, in lower case.
  bool is_needed = true;
};

/// The columns of a CSV table in the order asked for, whatever their order there; others are
/// passed over, and so are those that are neither needed nor there.
///
/// @param names  A column of landmarks' names to read as well; nullptr: none.
/// @throws IoError naming the line if there is no such header, a needed column is not there or
///         twice, or a cell of one is not a finite number or an empty name.
NumberTable read_columns(ByteSource& input, const std::vector<CsvColumn>& numbers,
                         const CsvColumn* names = nullptr);

/// Whether a table's first row names all the columns that are needed.
bool names_columns(const TableRow& row, const std::vector<CsvColumn>& columns);

}  // namespace mapproof
