#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace mapproof {

/// The files that records are kept in, seconds apart: those of a study of either kind, of a map or
/// of one log's result. Paths below `place`, ascending; what cannot be listed is left out.
std::vector<std::filesystem::path> record_files(const std::filesystem::path& place);

/// The folder below `root` whose record_files() include the file; empty if none does.
/// @param file  Below `root`; it need not be there.
std::optional<std::filesystem::path> folder_of_record(const std::filesystem::path& root,
                                                      const std::filesystem::path& file);

/// Whether both files are there and hold the same bytes.
bool same_bytes(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace mapproof
