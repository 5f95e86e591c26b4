#pragma once

#include <string>
#include <string_view>

#include "core/base/files/byte_source.hpp"
#include "core/records/tables/column_names.hpp"

namespace mapproof {

/// Replaces an unread source that holds a table in another form than text by the same table as CSV,
/// called "NAME, read as a table": NumPy's .npy and .npz, lines or a list of JSON objects without a
/// schema, and the bearing-range edges of g2o and GTSAM. Other sources stay as they are.
/// @throws IoError if the source cannot be read as what it is; for a file of another known kind,
///         see refuse_other_kind().
void respell(ByteSource& source);

/// Marks the named columns that a table, which stays unread, has, see NamedColumn::is_elsewhere.
/// @throws IoError as respell().
void mark_columns(ByteSource& table, ColumnNames& columns);

/// Marks the named columns that a file has. A stream, which is read once, and a folder are left
/// alone. @throws IoError as respell().
void mark_columns_of_file(const std::string& path, ColumnNames& columns);

/// Refuses named columns that a table, which stays unread, does not have; JSON of a schema is left
/// to its reader. @throws IoError as respell(), or as require_columns().
void require_columns(ByteSource& table, const ColumnNames& columns);

/// Refuses what is known by its first bytes and not read: spreadsheets, HDF5, Parquet, pickles,
/// archives, images, databases, bags.
/// @throws IoError with what it is, and what converts it.
void refuse_other_kind(std::string_view start, const std::string& source);

/// Whether a ZIP archive begins with an array of NumPy.
bool is_npz(std::string_view start);

// The forms; all throw IoError.

std::string npz_csv(std::string_view bytes, const std::string& source);
/// Objects, or lists of cells, without a schema of mapproof.
bool holds_json_rows(ByteSource& source);
/// Whether each line is an object of its own.
bool holds_json_lines(std::string_view text);
/// @param text  From checked_text().
std::string json_rows_csv(std::string_view text, const std::string& source);
/// Edges EDGE_SE2_XY, EDGE_BEARING_SE2_XY, BR and LANDMARK: step, landmark, range, bearing.
std::string graph_csv(std::string_view text, const std::string& source);

}  // namespace mapproof
