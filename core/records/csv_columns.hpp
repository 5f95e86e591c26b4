#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "core/records/range_tables.hpp"

namespace mapproof {

/// A column that a table names in its header.
struct CsvColumn {
  std::string_view label;               ///< For errors.
  std::vector<std::string_view> words;  ///< What the header may call it, in lower case.
  bool is_needed = true;
};

/// The columns of a CSV file in the order asked for, whatever their order in the file; others are
/// passed over, and so are those that are neither needed nor there.
///
/// @param names  A column of landmarks' names to read as well; nullptr: none.
/// @throws IoError naming the line if there is no such header, a needed column is not there or
///         twice, or a cell of one is no finite number or an empty name.
NumberTable read_columns(const std::filesystem::path& path, const std::vector<CsvColumn>& numbers,
                         const CsvColumn* names = nullptr);

/// Whether the first row of a CSV text names all the columns that are needed.
bool has_columns(std::string_view text, const std::vector<CsvColumn>& columns);

}  // namespace mapproof
