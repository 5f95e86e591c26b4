#pragma once

#include <string>
#include <string_view>

#include "core/model/map_record.hpp"

namespace mapproof {

/// Reads a map as CSV: a header with the columns name, x_m and y_m (or x and y, of a map without
/// the frame of the ground truth), and as it likes true_x_m, true_y_m and anchor (0 or 1); the
/// columns that map_csv() adds are passed over. One row per landmark; empty numbers are not known.
/// @param text  From checked_text().
/// @return Without an id; what it was observed and made by is not known.
/// @throws IoError with the line: columns that are missing, unknown or there twice, a row of
///         another length, a cell that is not a number, one coordinate without the other, a name
///         that is empty or there twice, no row.
MapRecord parse_map_csv(std::string_view text, const std::string& source);

}  // namespace mapproof
