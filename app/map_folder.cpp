#include "app/map_folder.hpp"

#include <algorithm>
#include <system_error>

#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/records/study_store.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

const fs::path& made(const fs::path& folder) {
  check_map_folder(folder);
  make_folder(folder);
  return folder;
}

/// Whether there is anything but what a killed process left beside its files.
bool holds_files(const fs::path& folder) {
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (; !error && entry != fs::directory_iterator(); entry.increment(error))
    if (!is_leftover(entry->path())) return true;
  if (error) throw IoError(folder.string(), "cannot be listed: " + error.message());
  return false;
}

}  // namespace

void check_map_folder(const fs::path& folder) {
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (status.type() == fs::file_type::not_found) return;
  if (error) throw IoError(folder.string(), error.message());
  if (status.type() != fs::file_type::directory) throw IoError(folder.string(), "is not a folder");
  if (is_study(folder))
    throw IoError(folder.string(), "holds a study; choose another --out for the map");
  if (!fs::exists(folder / kMapFile, error) && holds_files(folder))
    throw IoError(folder.string(), "holds files that are no map; choose another --out");
}

MapFolder::MapFolder(const fs::path& folder) : path_(folder), lock_(made(folder)) {
  remove_leftovers(folder);
}

}  // namespace mapproof
