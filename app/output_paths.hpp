#pragma once

#include <filesystem>
#include <span>

#include "app/diff/diff_options.hpp"

namespace mapproof {

/// Refuses outputs that would replace what is compared: one of `inputs` itself, the path of a
/// figure, image, table or page in one that is a folder, or a file there that is not an earlier
/// output of the same type. Two outputs cannot share a path either.
/// @throws InvalidInput, IoError for what is not a regular file.
void check_output_paths(const DiffOptions& options, std::span<const std::filesystem::path> inputs);

}  // namespace mapproof
