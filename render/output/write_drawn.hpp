#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace mapproof {

/// Draws a file's bytes and writes them.
/// @throws IoError if they cannot be written; what a library has against them with the file's name:
///         OutOfMemory, or std::runtime_error. Then the file is what it was.
void write_drawn(const std::filesystem::path& path, const std::function<std::string()>& draw);

}  // namespace mapproof
