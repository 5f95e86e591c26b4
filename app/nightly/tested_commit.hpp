#pragma once

#include <optional>
#include <string>

namespace mapproof {

/// The commit that a nightly run measures.
struct TestedCommit {
  std::string id = {};          ///< In hexadecimal digits; empty: not known.
  std::string repository = {};  ///< Its address, without a '/' at its end; empty: not known.
};

/// What the command line says of it.
struct CommitOptions {
  std::optional<std::string> commit = {};      ///< "none": none is named.
  std::optional<std::string> repository = {};  ///< "none" likewise.
};

/// The commit that is asked for, else HEAD of the git repository that the current folder lies in,
/// else `otherwise`; the address that is asked for, else that of the remote "origin".
/// @throws InvalidInput for a commit that is not a hexadecimal id, and for an address that is not a
///         plain http or https one.
TestedCommit tested_commit(const CommitOptions& options, const TestedCommit& otherwise);

/// The page of a remote: "https://github.com/me/x" of "git@github.com:me/x.git", of
/// "ssh://git@github.com/me/x" and of "https://user:secret@github.com/me/x.git". Empty for others,
/// as a folder.
std::string page_of_remote(const std::string& remote);

}  // namespace mapproof
