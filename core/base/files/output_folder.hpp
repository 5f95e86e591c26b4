#pragma once

#include <concepts>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace mapproof {

/// Makes the folder and those above it. @throws IoError if that cannot be done.
void make_folder(const std::filesystem::path& path);

/// A folder that files are written to. Links are followed in the path that somebody named, and
/// nowhere below it: a folder that was handed over cannot lead a write out of it. A file is written
/// next to its target under a random name and renamed: after a kill or a full disk either the old
/// file or the new one is there, whole.
///
/// Files are relative to the folder, and may be in folders below it.
/// @throws IoError, from every function, with the path: if a file or a folder below the named path
///         is a symbolic link, or the file system refuses; nothing is left behind.
/// @throws InvalidInput for a path that is absolute or holds "..".
class OutputFolder {
 public:
  OutputFolder(std::filesystem::path named) : named_(std::move(named)) {}
  template <typename Text>
  requires std::convertible_to<Text, std::filesystem::path> OutputFolder(const Text& named)
      : named_(named) {}

  /// A folder below it.
  OutputFolder operator/(const std::filesystem::path& inner) const;
  std::filesystem::path path() const { return inner_.empty() ? named_ : named_ / inner_; }

  /// The bytes of a regular file; nothing if it is missing.
  std::optional<std::string> read(const std::filesystem::path& file) const;
  /// Replaces the file, or makes it. Folders above it are made.
  void write(const std::filesystem::path& file, std::string_view bytes) const;
  /// The same, and returns when a loss of power cannot undo it: syncs the file and its folder.
  void write_durably(const std::filesystem::path& file, std::string_view bytes) const;
  /// Adds to the end of the file, which is made if it is missing. If the disk is full, nothing is
  /// added; after a kill a part of `bytes` may be there. A file that has another name as well (a
  /// hard link) is replaced by a longer copy: what the other name leads to stays as it is.
  void append(const std::filesystem::path& file, std::string_view bytes) const;
  /// Removes a file, or a folder with all that is in it; a link, not what it leads to. What is
  /// missing counts as removed.
  void remove(const std::filesystem::path& file) const;

 private:
  std::filesystem::path named_, inner_;
};

/// A name that no file has, next to `name`: "NAME.part-PID-16 hexadecimal digits".
std::string part_name(const std::string& name);

/// Waits until the entries of a folder are on the disk. A file system that cannot do this, as some
/// on a network, is not an error.
/// @throws IoError.
void sync_folder(const std::filesystem::path& folder);

/// @throws IoError that names the first symbolic link in the folder, or in the folders below it,
///         that leads out of it, whether or not something is there. A path that is not a folder
///         holds none.
/// @note One lstat() per file.
void refuse_links_out(const std::filesystem::path& folder);

}  // namespace mapproof
