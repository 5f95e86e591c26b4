#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/descriptor.hpp"

namespace mapproof {

/// Number of the stream that a path names and this process was handed: 0 for "-" and /dev/stdin, N
/// for /dev/fd/N and /proc/self/fd/N, as a shell's <(...) makes them. Empty for other paths.
std::optional<int> handed_in(const std::filesystem::path& path);

/// What an input is called in messages: its path, or "standard input" for "-".
std::string input_name(const std::filesystem::path& path);

/// Whether an input is a folder. "-" is standard input, whatever else is called so.
bool is_folder(const std::filesystem::path& path);

/// "a pipe": of what has no end, or none that can be waited for.
/// @param mode  As stat() gives it: of neither a file nor a folder.
const char* endless_kind(mode_t mode);

/// Opens a file, or a stream that was handed in: these are read to their end. A file is read from
/// its start, even as /dev/fd/N; as "-" from where its stream stands.
/// @throws IoError if it cannot be opened or is a folder; or, at once, for a named pipe, a socket
///         or a device, whose end nobody could wait for. Of the devices that were handed in,
///         terminals and /dev/null are taken.
Descriptor open_input(const std::filesystem::path& path);

/// Opens what is to be followed: named pipes and devices too. Never waits: a named pipe that nobody
/// writes to yet has nothing to read.
/// @throws IoError if it cannot be opened or is a folder.
Descriptor open_followed(const std::filesystem::path& path);

/// The next bytes. Waits for them. @return How many; 0 at the end. @throws IoError of `name`.
std::size_t read_some(const Descriptor& file, std::span<char> to, const std::string& name);

/// The bytes as a file without a name, for who seeks in it or reads it more than once.
/// @throws IoError of `name` if there is no memory for it.
Descriptor anonymous_file(std::string_view bytes, const std::string& name);

/// "/proc/self/fd/7": opens the file of a descriptor again, from its start, while it is open.
std::string path_of(const Descriptor& file);

/// The file, or else the one beside it that is called so and packed: NAME.gz or NAME.xz. The path
/// itself, if none of them is there.
std::filesystem::path plain_or_packed(const std::filesystem::path& path);

/// The path without the ending .gz or .xz.
std::filesystem::path unpacked_name(const std::filesystem::path& path);

}  // namespace mapproof
