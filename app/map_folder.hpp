#pragma once

#include <filesystem>

#include "core/records/folder_lock.hpp"

namespace mapproof {

/// The file that marks a folder as that of a map.
inline constexpr const char* kMapFile = "map.json";

/// Throws unless a map may be written there: the folder is new, empty, or holds an earlier map.
/// @throws IoError saying what is in the way.
void check_map_folder(const std::filesystem::path& folder);

/// The folder of a map while it is written: made, checked, locked, and rid of what a killed process
/// left behind.
class MapFolder {
 public:
  /// @throws IoError as check_map_folder, or if another process writes there.
  explicit MapFolder(const std::filesystem::path& folder);

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  FolderLock lock_;
};

}  // namespace mapproof
