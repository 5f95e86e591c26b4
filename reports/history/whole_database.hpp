#pragma once

#include <filesystem>
#include <memory>

#include "reports/history/database.hpp"

namespace mapproof {

/// A store's database, which is there and whole: by SQLite's own check, by its tables, and by the
/// words and numbers in them.
/// @throws DamagedFile if it is not whole: a file without tables is not, an empty one say; IoError
///         if it is not there, may not be read, is in use, or is not a store of ours.
std::unique_ptr<Database> open_whole(const std::filesystem::path& path, Database::Access access);

}  // namespace mapproof
