#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/files/descriptor.hpp"

namespace mapproof {

/// The number of the inherited file descriptor that a path names: 0 for "-" and /dev/stdin, 1 and 2
/// for /dev/stdout and /dev/stderr, N for /dev/fd/N and /proc/self/fd/N, as a shell's <(...) makes
/// them. Empty for other paths.
std::optional<int> handed_in(const std::filesystem::path& path);

/// The name of an input in messages: its path, or "standard input" for "-".
std::string input_name(const std::filesystem::path& path);

/// Whether an input is a folder. "-" is standard input, even where a folder has that name.
bool is_folder(const std::filesystem::path& path);

/// "a named pipe", "a socket" or "a device": an input without an end that can be waited for.
/// @param mode  As stat() gives it, neither of a regular file nor of a folder.
const char* endless_kind(mode_t mode);

/// Opens a file, or a stream that this process inherited, to be read to its end. A file is read
/// from its start, even as /dev/fd/N; as "-" from its current offset.
/// @throws IoError if it cannot be opened or is a folder; or, at once, for a named pipe, a socket
///         or a device, which may have no end. Inherited pipes, sockets, terminals and /dev/null
///         are opened.
Descriptor open_input(const std::filesystem::path& path);

/// Opens an input that is read while it grows: named pipes and devices too. Never waits: a named
/// pipe that nobody writes to yet has nothing to read.
/// @throws IoError if it cannot be opened or is a folder.
Descriptor open_streamed(const std::filesystem::path& path);

/// Reads the next bytes, and waits until there are any. @return How many; 0 at the end.
/// @throws IoError with `name`.
std::size_t read_some(const Descriptor& file, std::span<char> to, const std::string& name);

/// Holds the bytes in a file in memory, for a reader that seeks or reads them more than once.
/// @throws IoError with `name` if there is not enough memory.
Descriptor anonymous_file(std::string_view bytes, const std::string& name);

/// "/proc/self/fd/7": the path that opens the file of an open descriptor again, from its start.
std::string path_of(const Descriptor& file);

/// The first of PATH, PATH.gz and PATH.xz that exists; PATH if none does.
std::filesystem::path plain_or_packed(const std::filesystem::path& path);

/// The path without the ending .gz or .xz.
std::filesystem::path unpacked_name(const std::filesystem::path& path);

}  // namespace mapproof
