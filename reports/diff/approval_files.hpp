#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace mapproof {

inline constexpr const char* kRecordsItem = "records";  ///< All records of a study.

/// Files of the items on one side, below its folder: id, and the paths of it.
using ApprovalFiles = std::map<std::string, std::set<std::filesystem::path>>;

/// None of a folder that is not there. @throws IoError if it cannot be listed, or is no folder.
ApprovalFiles approval_files(const std::filesystem::path& root);

/// What cannot be read is never made a baseline. @throws InvalidInput with the reason.
void require_readable(const std::filesystem::path& file);

/// @throws InvalidInput if a folder has the file's name.
void require_no_folder(const std::filesystem::path& file);

/// A baseline's file goes only if nothing stands in its place: a folder, say, is no absence.
/// @throws InvalidInput.
void require_gone(const std::filesystem::path& file);

}  // namespace mapproof
