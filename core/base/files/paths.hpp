#pragma once

#include <filesystem>

namespace mapproof {

/// The path behind links, as far as it is there: absolute, without "." and a slash at its end.
std::filesystem::path real_path(const std::filesystem::path& path);

/// Whether `path` is `folder` or lies below it. Both as real_path() gives them.
bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder);

/// Whether one of two is the other or lies in it, links followed and folders that are mounted twice
/// recognised. They need not be there.
bool overlap(const std::filesystem::path& a, const std::filesystem::path& b);

/// Whether a file or a folder has the path, links followed.
/// @throws IoError if the system refuses to say so, as of a file in a folder that may not be
///         searched: that it is not there would be wrong.
bool is_there(const std::filesystem::path& path);

}  // namespace mapproof
