#pragma once

#include <filesystem>
#include <functional>
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

/// The same in parts of some megabyte, in their order.
void write_results_csv(const std::vector<Result>& rows,
                       const std::function<void(const std::string&)>& write);

/// Reads such a table, whatever the order of its columns and rows; `run`, `group` and `subject` may
/// be left out, and an empty group is the run. A level that reads as a number is one.
/// @return In order.
/// @throws IoError with the line: columns that are missing, unknown or there twice, a row of
///         another length, a cell that is not a number, a level beyond 1e100, a factor with numbers
///         and texts within one setup, a quantity that `quantities` lacks, a row that repeats
///         another one, a run in two groups.
std::vector<Result> parse_results_csv(std::string_view text, const std::string& source,
                                      const Quantities& quantities);

/// Reads the file of such a table, packed or not. It holds a few megabytes of the text.
/// @note O(n) time; 56 bytes per row 40 per different text, and for each different set
/// of levels 30 and 80 per level.
/// @throws IoError as parse_results_csv(), or if the file cannot be read.
std::vector<Result> read_results_csv(const std::filesystem::path& file,
                                     const Quantities& quantities);

/// The texts in the column `quantity` of such a file, each once, ascending; none without the
/// column. @throws IoError for a table that cannot be read as one.
std::vector<std::string> quantities_in(const std::filesystem::path& file);

}  // namespace mapproof
