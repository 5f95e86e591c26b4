#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "core/base/files/output_folder.hpp"

namespace mapproof {

/// Draws a file's bytes and writes them.
/// @throws IoError if they cannot be written; what a library has against them with the file's name:
///         OutOfMemory, or std::runtime_error. Then the file is what it was.
void write_drawn(const OutputFolder& folder, const std::filesystem::path& file,
                 const std::function<std::string()>& draw);

}  // namespace mapproof
