#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/files/temporary_folder.hpp"

namespace mapproof {

/// A folder in a commit of the git repository around the current folder: "origin/main:plots".
struct GitFolder {
  std::string ref;   ///< What git resolves to a commit: a branch, a tag, a hash, "HEAD~1".
  std::string path;  ///< From the root of the repository, or "./plots" from here; empty: the root.

  std::string text() const { return ref + ":" + path; }
};

/// Reads REF:PATH.
/// @throws InvalidInput for an empty ref, for one that git could take for an option, a range or a
///         search, for white space and control characters, and for a path out of the repository.
GitFolder parse_git_folder(const std::string& text);

/// The files of a folder in a commit, in a temporary folder as long as this object lives. They are
/// the bytes that git stores: no filter and no hook runs. Links and submodules are left out.
class GitBaseline {
 public:
  /// @throws InvalidInput with git's reason if git is missing, there is no repository, it has no
  ///         such commit, or the path is a file; IoError for more than 100,000 files or 4 GiB, and
  ///         for names that cannot be written safely.
  explicit GitBaseline(const GitFolder& source);

  /// Whether the commit has such a folder.
  bool exists() const { return exists_; }
  const std::filesystem::path& folder() const { return folder_.path(); }
  /// The folder of that name in the working tree, from the current folder; it need not exist.
  const std::string& working_folder() const { return working_folder_; }
  const std::string& commit() const { return commit_; }  ///< Its hash.
  /// Links and submodules, relative to the folder.
  const std::vector<std::string>& left_out() const { return left_out_; }

 private:
  TemporaryFolder folder_{"baseline"};
  std::string working_folder_;
  std::string commit_;
  std::vector<std::string> left_out_;
  bool exists_ = false;
};

}  // namespace mapproof
