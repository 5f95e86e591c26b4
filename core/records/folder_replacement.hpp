#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "core/records/folder_lock.hpp"

namespace mapproof {

/// A folder that is replaced in one step by a copy of it, in which files were written and removed.
/// After a kill at any moment it is wholly the old one or wholly the new one. Where a file system
/// cannot exchange two folders, a kill may leave it under another name, which recover_folder()
/// takes back.
///
/// The copy is made beside it, as .NAME.mapproof-PID-N. All files that are neither written nor
/// removed are taken over as they are, whoever they belong to: by hard links, so that they are not
/// copied, and by copies where there are no such links. Folders and files keep their modes.
class FolderReplacement {
 public:
  /// Makes the copy. A folder that is not there is taken for an empty one; one that is there should
  /// be locked.
  /// @param folder  As real_path() gives it.
  /// @throws IoError if it cannot be copied, may not be replaced as this process works in it, or
  ///         another file system is mounted in it.
  explicit FolderReplacement(const std::filesystem::path& folder);
  /// Removes the copy, or what it has replaced.
  ~FolderReplacement();
  FolderReplacement(const FolderReplacement&) = delete;
  FolderReplacement& operator=(const FolderReplacement&) = delete;

  /// Writes a file of the copy, which takes the mode of the one that it replaces. Folders above it
  /// are made. @param file  Below the folder. @throws IoError; never writes behind a link.
  void write(const std::filesystem::path& file, std::string_view bytes);

  /// Removes a file from the copy. @throws IoError.
  void remove(const std::filesystem::path& file);

  /// Puts the copy in the folder's place. @throws IoError: then the folder is the old one.
  void commit();

 private:
  void require_changeable(const std::filesystem::path& file) const;

  std::filesystem::path folder_, copy_;
  std::optional<FolderLock> lock_;  ///< Of the copy, which holds the folder's place in the end.
  bool is_new_ = false;             ///< The folder was not there.
};

/// Puts back a folder that a killed replacement left under another name, and removes what such ones
/// left beside it, as far as nobody is at work on it.
/// @param folder  As real_path() gives it.
/// @throws IoError if it cannot be put back.
void recover_folder(const std::filesystem::path& folder);

}  // namespace mapproof
