#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace mapproof {

/// The whole file, as it is: see open_input(), and read_input() for what may be packed.
/// @throws IoError if it cannot be read or holds more than `limit` bytes.
std::string read_file(const std::filesystem::path& path, std::size_t limit = std::size_t{1} << 31);

/// @throws IoError if read_file() would refuse the path without reading it.
void require_file(const std::filesystem::path& path);

/// Replaces a file that somebody named; if the path is a link, the file behind it. Otherwise as
/// OutputFolder::write(), which is for files below a folder.
/// @throws IoError, and leaves nothing behind.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace mapproof
