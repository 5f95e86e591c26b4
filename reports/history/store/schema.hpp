#pragma once

#include <filesystem>
#include <memory>

#include "reports/history/store/database.hpp"

namespace mapproof {

/// A store's database, which is there and whole: by SQLite's own check, by its tables, and by the
/// names and numbers in them.
/// @throws DamagedFile if it is not whole: a file without tables, such as an empty one, is not;
/// IoError
///         if it is not there, may not be read, is in use, or is not a store of ours.
std::unique_ptr<Database> open_whole(const std::filesystem::path& path, Database::Access access);

/// The version of the tables that this program writes, in PRAGMA user_version.
int schema_version();

/// The version of a file; 0: it has no tables yet. @throws IoError if it is not a store of ours or
/// of a later version than this program's.
int version_of(Database& database);

/// What is wrong with its tables: it has none, of those of its version one is missing, or a column
/// is; empty if nothing. @throws IoError as version_of() does.
std::string damage_of_tables(Database& database);

/// Makes the tables of a version (docs/file-formats.md lists them). For tests: one before the
/// latest.
/// @throws IoError; InvalidInput unless 1 <= version <= schema_version().
void make_tables(Database& database, int version);

/// Brings a store of an older version to the latest, in one transaction, after a copy was put in
/// the same folder: history.sqlite.v1-backup, with a number appended if that name is taken.
/// @return The copy; empty if there was nothing to do.
/// @throws IoError.
std::filesystem::path migrate(Database& database);

}  // namespace mapproof
