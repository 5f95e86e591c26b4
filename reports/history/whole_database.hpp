#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "reports/history/database.hpp"

namespace mapproof {

/// A store's database if it is whole: by SQLite's own check, by its tables, and by the words and
/// numbers in them. Null if it is damaged.
/// @param damage  What is wrong then.
/// @throws IoError if it may not be read, is in use, or is no store of ours.
std::unique_ptr<Database> open_whole(const std::filesystem::path& path, Database::Access access,
                                     std::string& damage);

/// Sets a damaged file aside, with the journal that belongs to it. @return Its new name.
/// @throws IoError if it cannot be renamed.
std::filesystem::path set_aside(const std::filesystem::path& path);

}  // namespace mapproof
