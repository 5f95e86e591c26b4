#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/results/results.hpp"

namespace mapproof {

/// results.csv (docs/file-formats.md): a header and one row per number, in the order of `rows`.
/// Columns `setup, method, quantity, run, group, subject, value`, and `at.NAME` of each factor, in
/// ascending order. Numbers as csv_number() writes them, an infinite one `inf`; a lost value is an
/// empty cell, as is the level of a factor that a row's condition does not have.
std::string results_csv(const std::vector<Result>& rows);

/// Reads such a table, whatever the order of its columns and rows; `run`, `group` and `subject` may
/// be left out, and an empty group is the run. A level that reads as a number is one.
/// @return In order.
/// @throws IoError with the line: columns that are missing, unknown or there twice, a row of
///         another length, a cell that is not a number, a level beyond 1e100, a factor with numbers
///         and texts within one setup, a quantity that `quantities` lacks, a row that repeats
///         another one, a run in two groups.
std::vector<Result> parse_results_csv(std::string_view text, const std::string& source,
                                      const Quantities& quantities);

/// The texts in the column `quantity` of such a table, each once, ascending; none without the
/// column. @throws IoError for a table that cannot be read as one.
std::vector<std::string> quantities_in(std::string_view text, const std::string& source);

}  // namespace mapproof
