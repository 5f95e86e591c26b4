#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "reports/diff/records/record_diff.hpp"

namespace mapproof {

/// Whether the content of the table with that id differs from run to run: seconds, dates, hosts,
/// commands.
bool varies(std::string_view table);

/// The differences of two tables of one format ("csv", "md", "tex"), cell by cell.
struct TableDiff {
  OtherDiff cells;        ///< Locations are "row 3 (ISOMAP), MPE [m]".
  bool is_style = false;  ///< Only headings, captions or markup differ.
};

/// @param tolerance  Of numbers, also of those within texts.
/// @throws IoError if either cannot be read as a table of that format.
TableDiff table_diff(const std::string& format, const std::filesystem::path& baseline,
                     const std::filesystem::path& current, const Tolerance& tolerance);

/// Whether both have the same headings.
bool same_headings(const std::string& format, const std::filesystem::path& baseline,
                   const std::filesystem::path& current);

}  // namespace mapproof
