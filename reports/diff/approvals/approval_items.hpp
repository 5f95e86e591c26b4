#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace mapproof {

inline constexpr const char* kRecordsItem = "records";  ///< All records of a study.

/// The files of each item of one side, by its id; paths relative to the side's folder.
using ApprovalFiles = std::map<std::string, std::set<std::filesystem::path>>;

/// The items of a folder; none if it does not exist.
/// @throws IoError if it cannot be listed, or is not a folder.
ApprovalFiles approval_files(const std::filesystem::path& root);

/// A link never becomes a baseline, nor what one leads to.
/// @param file  Relative to the folder `root`.
/// @throws InvalidInput unless it is a regular file, in folders that are no links.
void require_plain(const std::filesystem::path& root, const std::filesystem::path& file);

/// A file that cannot be read never becomes a baseline. @throws InvalidInput with the reason.
void require_readable(const std::filesystem::path& file);

/// @throws InvalidInput if a folder has the file's name.
void require_no_folder(const std::filesystem::path& file);

/// A file of the baseline is removed only if the current has nothing of its name.
/// @param file  The path in the current. @throws InvalidInput if anything is there, as a folder.
void require_gone(const std::filesystem::path& file);

}  // namespace mapproof
