#pragma once

#include <filesystem>
#include <functional>

#include "core/base/files/descriptor.hpp"
#include "core/base/files/output_folder.hpp"

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

/// Removes the files that OutputFolder left behind when its process was killed, unless that process
/// still runs: here, and below in the folders that records, reports and `render` write, by their
/// names, and in studies. No link is followed.
/// @throws IoError if a folder cannot be searched.
void remove_leftovers(const std::filesystem::path& folder);

/// Whether the file has the name of such a leftover, of any process: as part_name() makes it,
/// "NAME.part-PID-16 hexadecimal digits".
bool is_leftover(const std::filesystem::path& file);

/// A folder that a command writes to: made, locked as long as this object lives, and rid of what a
/// killed process left behind.
class LockedFolder {
 public:
  /// @param folder  As somebody named it: links in this path are followed, none below it is.
  /// @throws IoError if it cannot be made, as FolderLock or as remove_leftovers().
  explicit LockedFolder(const std::filesystem::path& folder);

  const FolderLock& lock() const { return lock_; }
  const OutputFolder& files() const { return files_; }

 private:
  OutputFolder files_;
  FolderLock lock_;
};

}  // namespace mapproof
