#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/records/studies/folder_lock.hpp"

namespace mapproof {

/// Replaces a folder in one step by a copy of it, in which files were written and removed. After a
/// kill at any moment the folder is wholly the old one or wholly the new one. Where a file system
/// cannot exchange two folders, a kill may leave the old one as .NAME.mapproof-old, from where
/// recover_folder() puts it back.
///
/// The copy is made next to the folder, as .NAME.mapproof-PID-N. Files that are neither written nor
/// removed get hard links in it, whoever owns them, and are copied where no hard link can be made.
/// Folders and files keep their modes.
class FolderReplacement {
 public:
  /// Makes the copy. A folder that does not exist counts as an empty one.
  /// @param folder  As real_path() gives it. The caller holds its lock, if it exists.
  /// @throws IoError if the folder cannot be copied, if the working directory of this process is in
  ///         it, or if another file system is mounted in it.
  /// @note One link or copy per file below the folder.
  explicit FolderReplacement(const std::filesystem::path& folder);
  /// Removes the copy; after commit() the old folder.
  ~FolderReplacement();
  FolderReplacement(const FolderReplacement&) = delete;
  FolderReplacement& operator=(const FolderReplacement&) = delete;

  /// Path of the copy, to be read.
  const std::filesystem::path& copy() const { return copy_; }

  /// Writes a file of the copy, with the mode of the file that it replaces, if any. Makes the
  /// folders above it.
  /// @param file  Relative to the folder.
  /// @throws IoError if it cannot be written, or lies behind a symbolic link.
  void write(const std::filesystem::path& file, std::string_view bytes);

  /// Removes a file from the copy.
  /// @param file  Relative to the folder.
  /// @throws IoError if it cannot be removed, or lies behind a symbolic link.
  void remove(const std::filesystem::path& file);

  /// Exchanges the folder and the copy, and returns when a loss of power cannot undo it.
  /// @throws IoError, and leaves the old folder.
  void commit();

  /// Removes the old folder, after commit(); the destructor ignores that it cannot.
  /// @throws IoError that names what is left.
  void remove_old();

 private:
  void require_changeable(const std::filesystem::path& file) const;

  std::filesystem::path folder_, copy_;
  std::optional<FolderLock> lock_;  ///< Of the copy, so that it is locked when it is the folder.
  bool is_new_ = false;             ///< The folder did not exist.
};

/// Puts back a folder that a killed replacement left under another name, and removes the copies
/// that killed replacements left next to it, except those that another process has locked.
/// @param folder  As real_path() gives it.
/// @throws IoError if the folder cannot be put back.
void recover_folder(const std::filesystem::path& folder);

}  // namespace mapproof
