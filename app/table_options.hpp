#pragma once

#include <span>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "core/records/observations/sources.hpp"

namespace mapproof {

/// How the user says that a table is to be read: the options that `map` and `validate` share.
struct TableOptions {
  std::string layout = "auto";
  bool degrees = false;
  std::string convention = "counterclockwise";  ///< Of bearings.
  std::vector<std::string> columns;             ///< "time=Zeit".

  std::string scan_window;  ///< Seconds, or with a unit; empty: found from the gaps.

  /// @throws InvalidInput for columns that name none of the roles, or one twice, or for a scan
  ///         window that is none.
  TableFormat format(std::span<const ColumnRole> roles = kTableRoles) const;
  /// Whether the table is stated to be one of landmarks and steps.
  bool is_grid() const { return layout == "wide" || layout == "transposed"; }
};

void add_table_options(CLI::App& app, TableOptions& options);

/// The name of a convention in options: "compass".
std::string_view name(BearingConvention convention);

}  // namespace mapproof
