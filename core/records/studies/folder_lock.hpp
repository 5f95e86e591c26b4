#pragma once

#include <filesystem>
#include <functional>

#include "core/base/files/descriptor.hpp"

namespace mapproof {

/// Locks a folder against other processes as long as this object lives: flock() on the folder
/// itself, so that no file is left behind; the kernel releases it when the process ends, however it
/// ends. On a file system without such locks (some network mounts) nothing is locked.
class FolderLock {
 public:
  /// @throws IoError if another process, or another lock of this one, holds the folder, or if the
  ///         folder cannot be opened.
  explicit FolderLock(const std::filesystem::path& folder);

  /// Waits until no other lock holds the folder.
  /// @param busy  Called once, before the wait, if there is one.
  /// @throws IoError if the folder cannot be opened.
  FolderLock(const std::filesystem::path& folder, const std::function<void()>& busy);

 private:
  Descriptor folder_;
};

/// Removes the files NAME.part-PID-RANDOM (see part_name()) that OutputFolder left behind when its
/// process was killed, here and in the folders below, unless that process still runs.
/// @throws IoError if a folder cannot be searched.
void remove_leftovers(const std::filesystem::path& folder);

/// Whether the file has the name of such a leftover, of any process.
bool is_leftover(const std::filesystem::path& file);

}  // namespace mapproof
