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

/// Makes the folder and those above it. @throws IoError if that cannot be done.
void make_folder(const std::filesystem::path& path);

/// Replaces the file at once: written next to it and renamed. After a kill or a full disk
/// either the old file or the new one is there, whole. Folders above it are made.
/// @throws IoError, and leaves nothing behind.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Adds to the end of the file, which is made if it is not there. If the disk is full, nothing is
/// added; after a kill a part of `bytes` may be there.
/// @throws IoError.
void append_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace mapproof
