#pragma once

#include <filesystem>
#include <vector>

#include "core/topics/validate.hpp"

namespace mapproof {

/// Checks whatever mapproof reads or writes: what core knows (see validate), and the images,
/// tables and pages that it writes and never reads again. Of a study's or a map's folder, both.
std::vector<Finding> validate_all(const std::filesystem::path& path, const ForeignReader& foreign,
                                  const ValidateOptions& options = {});

}  // namespace mapproof
