#pragma once

#include <filesystem>
#include <functional>

#include "core/base/descriptor.hpp"

namespace mapproof {

/// Keeps other processes out of a folder while it lives, without leaving a file behind: flock() on
/// the folder itself, which the kernel releases when the process ends, however it ends. Where a
/// file system knows no such locks (some network mounts), there is none.
class FolderLock {
 public:
  /// @throws IoError if another process, or another lock of this one, holds the folder.
  explicit FolderLock(const std::filesystem::path& folder);

  /// Waits until nobody else holds the folder. @param busy  Called once if there is a wait.
  /// @throws IoError if the folder cannot be opened.
  FolderLock(const std::filesystem::path& folder, const std::function<void()>& busy);

 private:
  Descriptor folder_;
};

/// Removes what write_file() left beside its places when its process was killed: NAME.part-PID,
/// here and in the folders below, unless that process still runs. @throws IoError.
void remove_leftovers(const std::filesystem::path& folder);

/// Whether the file's name is that of such a leftover, of whatever process.
bool is_leftover(const std::filesystem::path& file);

}  // namespace mapproof
