#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "reports/diff/records/record_diff.hpp"

namespace mapproof {

/// Whether a table of that id holds what no two makings share: seconds, dates, hosts, commands.
bool varies(std::string_view table);

/// What two tables of one format ("csv", "md", "tex") differ in, cell by cell.
struct TableDiff {
  OtherDiff cells;        ///< Places are "row 3 (ISOMAP), MPE [m]".
  bool is_style = false;  ///< Headings, captions or markup alone differ.
};

/// @param tolerance  Of numbers, in words too.
/// @throws IoError if either cannot be read as a table of that format.
TableDiff table_diff(const std::string& format, const std::filesystem::path& baseline,
                     const std::filesystem::path& current, const Tolerance& tolerance);

/// Whether both have the same headings.
bool same_headings(const std::string& format, const std::filesystem::path& baseline,
                   const std::filesystem::path& current);

}  // namespace mapproof
